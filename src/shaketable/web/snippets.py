"""What each part of the interface does, and a call of it from Python."""

from __future__ import annotations

HOST = "http://127.0.0.1:8000"

CALLS = {
    "simulate": f"""import httpx
asked = {{
    "thing": {{"width_m": 0.32, "height_m": 1.8, "friction": 0.5}},
    "shaking": {{"kind": "recording", "name": "NORTHR/MUL009"}},
}}
print(httpx.post("{HOST}/api/simulate", json=asked).json()["outcome"])""",
    "many": f"""import httpx
asked = {{"thing": {{"width_m": 0.32, "height_m": 1.8}}, "suite": "fema-p695-far-field"}}
found = httpx.post("{HOST}/api/many", json=asked).json()
print(found["falls"], "of", found["simulations"], found["low"], found["high"])""",
    "motion": f"""import httpx
asked = {{"shaking": {{"kind": "pulse", "period_s": 0.8, "peak_g": 0.4}}}}
print(max(httpx.post("{HOST}/api/motion", json=asked).json()["acceleration_g"]))""",
    "motions": f"""import httpx
print([each["name"] for each in httpx.get("{HOST}/api/motions").json()])""",
    "record": f"""import httpx
from pathlib import Path
data = Path("record.AT2").read_bytes()
read = httpx.put("{HOST}/api/record", params={{"name": "record.AT2"}}, content=data).json()
shaking = {{"kind": "uploaded", **read}}""",
}
DOES = {
    "simulate": "Shake one thing once.",
    "many": "Shake one thing by every motion of a suite, as recorded and reversed.",
    "motion": "A motion's trace and response spectrum.",
    "motions": "The recorded motions to choose from.",
    "record": "Read a record of acceleration: the file is the body of the request.",
}


def described(name: str) -> str:
    """A part of the interface in Markdown."""
    return f"{DOES[name]}\n\n```python\n{CALLS[name]}\n```"
