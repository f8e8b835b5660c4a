"""What each part of the interface does, and a call of it from Python."""

from __future__ import annotations

HOST = "http://127.0.0.1:8000"

CALLS = {
    "simulate": f"""import httpx
asked = {{
    "thing": {{"base_m": 0.32, "height_m": 1.8, "friction": 0.5}},
    "shaking": {{"kind": "recording", "name": "NORTHR/MUL009"}},
}}
print(httpx.post("{HOST}/api/simulate", json=asked).json()["outcome"])""",
    "many": f"""import httpx
asked = {{"thing": {{"base_m": 0.32, "height_m": 1.8}}, "suite": "fema-p695-both-directions"}}
found = httpx.post("{HOST}/api/many", json=asked).json()
print(found["falls"], "of", found["simulations"], found["low"], found["high"])""",
    "space/simulate": f"""import httpx
asked = {{
    "thing": {{"shape": "cylinder", "base_m": 0.23, "height_m": 1.6, "friction": 0.5}},
    "shaking": {{"kind": "recording", "name": "NORTHR/MUL009"}},
}}
print(httpx.post("{HOST}/api/space/simulate", json=asked).json()["fall_azimuth_deg"])""",
    "space/many": f"""import httpx
asked = {{"thing": {{"depth_m": 0.32, "width_m": 0.9, "height_m": 1.8}}, "curve": False}}
found = httpx.post("{HOST}/api/space/many", json=asked).json()
print(found["sides"], found["simulations"])""",
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
    "list": f"""import httpx
from pathlib import Path
data = Path("rooms.xlsx").read_bytes()
found = httpx.put("{HOST}/api/list", params={{"name": "rooms.xlsx"}}, content=data).json()
print(found["objects"], found["faults"])""",
    "assess": f"""import httpx
text = "name,depth_m,width_m,height_m\\nshelf,0.32,0.9,1.8\\n"
job = httpx.post("{HOST}/api/assess", json={{"text": text, "planar": True}}).json()["id"]
with httpx.stream("GET", f"{HOST}/api/assess/{{job}}/events", timeout=600) as told:
    for line in told.iter_lines():
        print(line)
found = httpx.get(f"{HOST}/api/assess/{{job}}").json()
print([(each["name"], each["share"], each["risk"]) for each in found["objects"]])""",
    "room": f"""import httpx
from pathlib import Path
data = Path("room.toml").read_bytes()
read = httpx.put("{HOST}/api/room", params={{"name": "room.toml"}}, content=data).json()
print(len(read["room"]["thing"]), [each["text"] for each in read["faults"]])""",
    "room/simulate": f"""import httpx
from pathlib import Path
asked = {{
    "text": Path("room.toml").read_text(),
    "shaking": {{"kind": "recording", "name": "NORTHR/MUL009"}},
}}
film = httpx.post("{HOST}/api/room/simulate", json=asked).json()
print([(each["name"], each["outcome"]) for each in film["things"]])""",
    "room/assess": f"""import httpx
from pathlib import Path
asked = {{"text": Path("room.toml").read_text(), "changes": True}}
job = httpx.post("{HOST}/api/room/assess", json=asked).json()["id"]
with httpx.stream("GET", f"{HOST}/api/assess/{{job}}/events", timeout=600) as told:
    for line in told.iter_lines():
        print(line)
found = httpx.get(f"{HOST}/api/assess/{{job}}").json()
print(found["summary"], found["changes"][0]["told"])""",
}
DOES = {
    "simulate": "Shake one thing once.",
    "many": "Shake one thing by every motion of a suite, as recorded and reversed.",
    "space/simulate": "Shake one box or cylinder once, by both horizontal components.",
    "space/many": "Shake one box or cylinder by every pair of components of a suite, as recorded "
    "and reversed.",
    "motion": "A motion's trace and response spectrum.",
    "motions": "The recorded motions to choose from.",
    "record": "Read a record of acceleration: the file is the body of the request.",
    "list": "Read a list of objects, in any format that `assess` reads: the file is the body of "
    "the request. Told are its rows, what the columns were taken for, and what is wrong.",
    "hazard": "Read the hazard curve of a site: the file is the body of the request. Told are the "
    "levels that come once in 72, 475 and 2,475 years, which `assess` takes.",
    "assess": "Assess a list of objects; the id is of the job that was begun.",
    "room": "Read a room, as the command line's `room check` does: the file is the body of the "
    "request. Told are its tables, and all that is wrong with its plan.",
    "room/simulate": "Shake all things of a room once, each beside the room's walls.",
    "room/assess": "Shake a room by every recording of a suite, as recorded and reversed, each in "
    "one direction where north is not known; the id is of the job that was begun.",
    "events": "How a job is, as server-sent events: waiting, running, done, failed or stopped.",
    "result": "What a job has found, the most pressing object first, in the language of "
    "Accept-Language: English, Spanish or German.",
    "stop": "Stop a job.",
    "file": "Its files: report.html; list.csv, the rows that were given with remarks; "
    "results.csv and results.parquet.",
}


def described(name: str) -> str:
    """A part of the interface in Markdown."""
    call = f"\n\n```python\n{CALLS[name]}\n```" if name in CALLS else ""
    return f"{DOES[name]}{call}"
