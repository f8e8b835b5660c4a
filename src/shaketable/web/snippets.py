"""A call of each part of the interface from Python, shown in its documentation."""

from __future__ import annotations

from typing import Any

HOST = "http://127.0.0.1:8000"


def _python(lines: str) -> dict[str, Any]:
    return {"x-codeSamples": [{"lang": "Python", "source": lines}]}


SNIPPETS = {
    "simulate": _python(
        f"""import httpx
asked = {{
    "thing": {{"width_m": 0.32, "height_m": 1.8, "friction": 0.5}},
    "shaking": {{"kind": "recording", "name": "NORTHR/MUL009"}},
}}
print(httpx.post("{HOST}/api/simulate", json=asked).json()["outcome"])"""
    ),
    "many": _python(
        f"""import httpx
asked = {{"thing": {{"width_m": 0.32, "height_m": 1.8}}, "suite": "fema-p695-far-field"}}
found = httpx.post("{HOST}/api/many", json=asked).json()
print(found["falls"], "of", found["simulations"], found["low"], found["high"])"""
    ),
    "motion": _python(
        f"""import httpx
asked = {{"shaking": {{"kind": "pulse", "period_s": 0.8, "peak_g": 0.4}}}}
print(max(httpx.post("{HOST}/api/motion", json=asked).json()["acceleration_g"]))"""
    ),
    "motions": _python(
        f"""import httpx
print([each["name"] for each in httpx.get("{HOST}/api/motions").json()])"""
    ),
    "record": _python(
        f"""import httpx
from pathlib import Path
data = Path("record.AT2").read_bytes()
read = httpx.put("{HOST}/api/record", params={{"name": "record.AT2"}}, content=data).json()
shaking = {{"kind": "uploaded", **read}}"""
    ),
}
