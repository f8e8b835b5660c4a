"""Views of an assessment: words, figures, a page, a table in the terminal, files."""
