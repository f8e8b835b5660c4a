"""The web page: one thing shaken in the browser, and the interface beneath it.

`create_app` makes the application, for a server of one's own; `serve` runs it on this machine.
"""

from shaketable.web.app import create_app
from shaketable.web.server import serve

__all__ = ["create_app", "serve"]
