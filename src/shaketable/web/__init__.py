"""The web page: one thing shaken in the browser, and the interface beneath it.

`app.create_app` makes the application, for a server of one's own; `server.serve` runs it on this
machine. Nothing is imported here, as workers do not need the server.
"""
