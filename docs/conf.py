"""Sphinx: how the site is built from the pages, the docstrings and the help texts.

`make docs` runs the notebooks and the gallery; DOCS_RUN=0 leaves both out, which takes a minute.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any
from weakref import WeakSet

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS))

from generated import escaped, write_api, write_commands, write_library  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from sphinx_gallery.scrapers import figure_rst  # noqa: E402

import shaketable  # noqa: E402

RUN = os.environ.get("DOCS_RUN", "1") == "1"

project = "shaketable"
author = "The shaketable developers"
copyright = "2026, the shaketable developers"  # noqa: A001
version = release = shaketable.__version__
language = "en"

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
    "myst_nb",
]
exclude_patterns = ["_build", "gallery/**", "gallery_of_examples/**.ipynb"]
source_suffix = {".rst": "restructuredtext", ".md": "myst-nb"}

# pages
myst_enable_extensions = ["colon_fence", "deflist"]
myst_heading_anchors = 4
nb_execution_mode = "force" if RUN else "off"
nb_execution_timeout = 120
nb_execution_raise_on_error = True
nb_execution_show_tb = True
nb_merge_streams = True
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True

# docstrings
default_role = "py:obj"
autodoc_member_order = "groupwise"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
python_maximum_signature_line_length = 88
napoleon_google_docstring = True
napoleon_numpy_docstring = False
napoleon_use_ivar = True

# gallery
SHOWN: WeakSet[Any] = WeakSet()  # figures: a value stays at hand in the blocks after its own


def package_figure(block: Any, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Show the figure of the axes that a block ends with; the package's own are not pyplot's."""
    value = block_vars["example_globals"].get("___")
    axes = value[0] if isinstance(value, tuple) else value
    if not isinstance(axes, Axes) or axes.get_figure(root=True) in SHOWN:
        return ""
    SHOWN.add(axes.get_figure(root=True))
    path = next(block_vars["image_path_iterator"])
    axes.get_figure(root=True).savefig(path, dpi=100)
    return str(figure_rst([path], gallery_conf["src_dir"]))


sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "gallery_of_examples",
    "filename_pattern": r"/plot_" if RUN else r"nothing_is_run",
    "plot_gallery": RUN,
    "backreferences_dir": "reference/backreferences",
    "doc_module": ("shaketable",),
    "within_subsection_order": "FileNameSortKey",
    "subsection_order": [
        f"gallery/{part}"
        for part in (
            "one_body",
            "walls_and_straps",
            "many_motions",
            "rooms_and_buildings",
            "loss_models",
            "your_own_data",
        )
    ],
    "download_all_examples": False,
    "remove_config_comments": True,
    "show_memory": False,
    "write_computation_times": False,
    "image_scrapers": ("matplotlib", package_figure),
    "capture_repr": ("_repr_html_", "__repr__"),
    "ignore_repr_types": r"matplotlib|tuple|list",
    "reset_modules": ("matplotlib",),
    "min_reported_time": 0,
}

# the site: nothing is fetched from other machines
html_theme = "pydata_sphinx_theme"
html_title = "shaketable"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_sourcelink = False
html_theme_options = {
    "logo": {"text": "shaketable"},
    "navbar_end": ["theme-switcher"],
    "header_links_before_dropdown": 6,
    "show_prev_next": True,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": ["sphinx-version"],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
html_sidebars = {"index": []}
# ref.python: a word in backticks that several classes have as an attribute is no link
suppress_warnings = ["config.cache", "mystnb.unknown_mime_type", "ref.python"]

if not RUN:  # the language of a notebook is known once it has run
    suppress_warnings.append("myst-nb.lexer")

write_api(DOCS / "reference")
write_commands(DOCS / "reference")
for table in ("edition-1.0", "fema-p58"):
    write_library(DOCS / "library_page", DOCS.parent / "library" / f"{table}.csv")


def escape_bars(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Absolute values in docstrings, |a_x|, are no substitutions."""
    lines[:] = [escaped(line) for line in lines]


def setup(app: Any) -> None:
    app.connect("autodoc-process-docstring", escape_bars)
