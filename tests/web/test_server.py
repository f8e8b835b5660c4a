"""The interface as programs meet it."""

from __future__ import annotations

import io
import json
import random
import re
import signal
import zipfile
from collections import Counter
from collections.abc import Iterator
from importlib import resources
from pathlib import Path

import httpx
import pandas as pd
import pytest

from shaketable import Body, Rocking, simulate_many, suite
from shaketable.web.snippets import CALLS, HOST
from tests.web.conftest import start_server

pytestmark = pytest.mark.web

STATIC = Path(str(resources.files("shaketable.web") / "static"))
THING = {"base_m": 0.32, "height_m": 1.8, "friction": 0.5}
LIST = "name,quantity,depth_m,width_m,height_m\nshelf,8,0.32,0.9,1.8\n=cmd|x,1,0.2,0.2,1.5\n"
PULSE = {"kind": "pulse", "period_s": 1.5, "peak_g": 0.6}


@pytest.fixture
def client(address: str) -> Iterator[httpx.Client]:
    with httpx.Client(base_url=address, timeout=60.0) as opened:
        yield opened


def test_shaking_one_thing(client: httpx.Client) -> None:
    found = client.post("/api/simulate", json={"thing": THING, "shaking": PULSE}).json()
    assert found["outcome"] in ("left", "right")
    assert len(found["frames"]["x_m"]) == len(found["frames"]["rotation_deg"])
    shares = client.post("/api/many", json={"thing": THING}).json()
    assert shares["simulations"] == 192  # 48 recordings, two components, each both ways
    assert len(client.get("/api/motions").json()) == 100


def test_every_answer_is_guarded(client: httpx.Client) -> None:
    assert client.head("/").status_code == 200
    for path in ("/", "/static/main.js", "/api/motions", "/nothing"):
        answer = client.get(path)
        policy = answer.headers["content-security-policy"]
        assert "default-src 'none'" in policy
        assert "unsafe" not in policy
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert "access-control-allow-origin" not in answer.headers
        assert "server" not in answer.headers


def test_it_is_called_by_its_own_names(client: httpx.Client) -> None:
    """Another site's page in the same browser is refused: by the name it used, or by its own."""
    port = client.base_url.port
    for host in (f"localhost:{port}", f"127.0.0.1:{port}", f"[::1]:{port}", "LOCALHOST"):
        assert client.get("/api/motions", headers={"Host": host}).status_code == 200
    for name, value in (
        ("Host", f"evil.example:{port}"),
        ("Host", "127.0.0.1.evil.example"),
        ("Host", "[::1"),
        ("Origin", "http://evil.example"),
        ("Origin", "null"),
    ):
        answer = client.get("/api/motions", headers={name: value})
        assert answer.status_code == 403, value
        assert answer.json()["detail"].startswith(name)
    same = {"Origin": f"http://127.0.0.1:{port}"}
    assert client.post("/api/many", json={"thing": THING}, headers=same).status_code == 200


def test_the_page_is_small_and_asks_nobody_else(client: httpx.Client) -> None:
    """Below 300 kB before anything is drawn in three dimensions; no address but its own."""
    files = [path.name for path in STATIC.iterdir() if path.suffix in (".js", ".css", ".html")]
    texts = [client.get(f"/static/{name}").text for name in files]
    assert sum(len(text.encode()) for text in texts) < 300_000
    for text in texts:
        addresses = text.replace("http://www.w3.org/2000/svg", "")  # a name, never asked
        assert "http:" not in addresses
        assert "https:" not in addresses
        assert "<script>" not in text
        assert "style=" not in text


@pytest.mark.parametrize(
    ("wrong", "field"),
    [
        ({"thing": {**THING, "base_m": -1}}, "thing.base_m"),
        ({"thing": {**THING, "weight": 3}}, "thing.weight"),
        ({"shaking": {"kind": "rumour"}}, "shaking"),
        ({"scale": "NaN"}, "scale"),
        ({"thing": None}, "thing"),
    ],
)
def test_wrong_fields_are_named(client: httpx.Client, wrong: dict[str, object], field: str) -> None:
    answer = client.post("/api/simulate", json={"thing": THING, "shaking": PULSE, **wrong})
    assert answer.status_code == 422
    assert answer.json()["fields"][0]["field"].startswith(field)


def test_what_cannot_stand_is_told_in_words(client: httpx.Client) -> None:
    steep = {"thing": {**THING, "tilt_deg": 25}, "shaking": PULSE}
    answer = client.post("/api/simulate", json=steep)
    assert answer.status_code == 422
    assert "falls" in answer.json()["detail"]


def test_too_much_is_not_taken(client: httpx.Client) -> None:
    answer = client.put("/api/record", params={"name": "a.txt"}, content=b"0" * 20_000_001)
    assert answer.status_code == 413
    assert client.post("/api/simulate", content=b"[" * 5_000_000).status_code == 413
    chunks = client.post("/api/simulate", content=iter([b"{", b"}"]))
    assert chunks.status_code == 411
    both = {"Content-Length": "2", "Transfer-Encoding": "chunked"}
    assert client.post("/api/simulate", content=iter([b"{}"]), headers=both).status_code == 411
    many = {"kind": "uploaded", "time_step_s": 0.01, "acceleration": ["a"] * 50_000}
    answer = client.post("/api/simulate", json={"thing": THING, "shaking": many})
    assert answer.status_code == 422
    assert len(answer.content) < 10_000
    hours = {"kind": "uploaded", "time_step_s": 1, "acceleration": [0] * 50_000}
    answer = client.post("/api/simulate", json={"thing": THING, "shaking": hours})
    assert answer.status_code == 422
    assert "at most 600 s" in answer.json()["detail"]
    assert client.post("/api/simulate", content=b"[" * 100_000).status_code == 422


def test_a_thousand_damaged_uploads_are_refused_with_words(client: httpx.Client) -> None:
    """Seeded damage of records and lists: an answer other than 200 says what is wrong."""
    record = "\n".join(f"{0.01 * k:.2f},{(-1) ** k * 0.5}" for k in range(60))
    book = io.BytesIO()
    pd.read_csv(io.StringIO(LIST)).to_excel(book, index=False)
    sound = [
        ("record", f"time_s,acceleration_m_s2\n{record}".encode(), ["csv", "AT2", "zip", "mseed"]),
        ("list", LIST.encode(), ["csv", "txt", "xlsx", "ods"]),
        ("list", book.getvalue(), ["xlsx", "xlsx", "ods", "csv"]),
    ]
    seeded = random.Random(7)
    answered = Counter[int]()
    for k in range(1000):
        path, whole, endings = sound[k % 3]
        data = bytearray(whole)
        for _ in range(seeded.randrange(1, 12)):
            data[seeded.randrange(len(data))] = seeded.randrange(256)
        if k % 7 == 0:
            del data[seeded.randrange(len(data)) :]
        name = ["a", "../../a", "a\x00b", "é\u202e"][k % 4] + f".{endings[k // 3 % 4]}"
        answer = client.put(f"/api/{path}", params={"name": name}, content=bytes(data))
        answered[answer.status_code] += 1
        assert "Traceback" not in answer.text
        assert "shaketable-" not in answer.text
    assert answered.keys() == {200, 422}


@pytest.mark.parametrize("ending", ["xlsx", "zip", "ods", "csv"])
def test_a_bomb_of_zeros_does_no_harm(client: httpx.Client, ending: str) -> None:
    """A gibibyte in a file of one megabyte, as what a spreadsheet and an archive keep."""
    bomb = io.BytesIO()
    with zipfile.ZipFile(bomb, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in ("xl/worksheets/sheet1.xml", "content.xml", "record.txt"):
            with archive.open(name, "w") as inside:
                for _ in range(340):
                    inside.write(bytes(1 << 20))
    for path in ("record", "list"):
        answer = client.put(f"/api/{path}", params={"name": f"a.{ending}"}, content=bomb.getvalue())
        assert answer.status_code in (422, 503), answer.text
        assert answer.json()["detail"]
    assert client.get("/api/motions").status_code == 200


def test_who_leaves_frees_his_place(client: httpx.Client) -> None:
    """Questions that wait are dropped with their visitor: the next is answered soon."""
    slow = {"thing": {"depth_m": 0.3, "width_m": 0.9, "height_m": 1.8}}  # some seconds each
    headers = {"X-Visitor": "leaves"}
    for _ in range(12):  # more than may wait
        with pytest.raises(httpx.ReadTimeout):
            client.post("/api/space/many", json=slow, headers=headers, timeout=0.7)
    answer = client.post(
        "/api/simulate", json={"thing": THING, "shaking": PULSE}, headers=headers, timeout=30.0
    )
    assert answer.status_code == 200


def test_unknown_pages_tell_nothing_of_the_machine(client: httpx.Client) -> None:
    for path in ("/static/../app.py", "/static/%2e%2e/app.py", "/texts/..%2f..%2fapp.py", "/admin"):
        answer = client.get(path)
        assert answer.status_code == 404
        assert "shaketable/web" not in answer.text


def test_the_interface_is_described_with_calls_that_work(
    client: httpx.Client, address: str, capsys: pytest.CaptureFixture[str]
) -> None:
    described = client.get("/openapi.json").json()
    for path in ("/api/simulate", "/api/many", "/api/motion", "/api/motions", "/api/record"):
        (method,) = described["paths"][path].values()
        assert "```python" in method["description"]
    for name in ("simulate", "many", "space/simulate", "space/many", "motion", "motions"):
        source = CALLS[name].replace(HOST, address)
        exec(compile(source, name, "exec"), {})
    assert capsys.readouterr().out.startswith(("left", "right", "standing"))


def test_it_is_served_below_a_path() -> None:
    """A proxy takes the path away; what the pages name is relative, and the description says it."""
    server, address = start_server(
        "--root-path", "/shaketable", "--name", "shake.example.org", computes=False
    )
    for name, code in (("shake.example.org", 200), ("example.org", 403)):
        assert httpx.get(f"{address}/", headers={"Host": name}).status_code == code
    assert httpx.get(f"{address}/openapi.json").json()["servers"] == [{"url": "/shaketable"}]
    for page in ("/", "/list", "/docs"):
        text = httpx.get(f"{address}{page}").text
        assert not re.search(r'(?:href|src)="/', text)
    server.terminate()
    server.communicate(timeout=30)


@pytest.mark.parametrize(("end", "computes"), [(signal.SIGTERM, True), (signal.SIGINT, False)])
def test_the_server_ends_cleanly(end: signal.Signals, computes: bool) -> None:
    """Its workers end with it, those too that have just begun: its output would stay open."""
    server, address = start_server(computes=computes)
    assert httpx.get(address, timeout=10.0).status_code == 200
    server.send_signal(end)
    out, _ = server.communicate(timeout=30)
    assert "Traceback" not in out, out
    assert server.returncode == 0


def ended(client: httpx.Client, job: str) -> dict[str, object]:
    """The last that a job tells of itself."""
    with client.stream("GET", f"/api/assess/{job}/events", timeout=600.0) as told:
        assert told.headers["content-type"].startswith("text/event-stream")
        lines = [line for line in told.iter_lines() if line.startswith("data: ")]
    found: dict[str, object] = json.loads(lines[-1].removeprefix("data: "))
    return found


def test_a_list_is_understood_and_its_faults_are_told(client: httpx.Client) -> None:
    found = client.put("/api/list", params={"name": "mine.csv"}, content=LIST.encode()).json()
    assert found["faults"] == []
    assert found["objects"] == 2
    assert found["columns"][2] == {
        "header": "depth_m", "meaning": "depth", "unit": "m", "renamed": False,
        "unused": False, "asked": False,
    }  # fmt: skip
    broken = LIST.replace("1.8", "1.8.")
    found = client.put("/api/list", params={"name": "mine.csv"}, content=broken.encode()).json()
    assert "mine.csv" in found["faults"][0]
    assert "'1.8.'" in found["faults"][0]
    assert found["rows"][0][4] == "1.8."
    given = {"params": {"name": "mine.csv"}, "content": broken.encode()}
    told = client.put("/api/list", headers={"Accept-Language": "fr, es;q=0.8"}, **given).json()
    assert "línea 2, height_m: se esperaba un número positivo" in told["faults"][0]
    assert {"meaning": "depth", "label": "fondo"}.items() <= told["meanings"][1].items()


def test_a_list_is_assessed(client: httpx.Client) -> None:
    """Names that would be formulas in a spreadsheet are not, and the report runs no script."""
    asked = {"text": LIST, "planar": True, "suite": "fema-p695-near-field-pulse"}
    job = client.post("/api/assess", json=asked).json()["id"]
    assert ended(client, job) == {"state": "done"}
    found = client.get(f"/api/assess/{job}").json()
    shelf = next(each for each in found["objects"] if each["name"] == "shelf")
    assert 0.0 < shelf["low"] < shelf["share"] < shelf["high"]
    assert shelf["thing"]["base_m"] == 0.32
    spanish = client.get(f"/api/assess/{job}", headers={"Accept-Language": "es-CL,es;q=0.9"}).json()
    told = next(each for each in spanish["objects"] if each["name"] == "shelf")
    assert told["measure"] == "anclarlo o sujetarlo con correa"
    assert told["happens"][0].startswith("Se vuelca en ")
    assert told["share"] == shelf["share"]
    header = client.get(f"/api/assess/{job}/lista.csv").text.splitlines()[0]
    assert header.endswith(",probable,riesgo,qué hacer primero")
    remarks = client.get(f"/api/assess/{job}/list.csv").text.splitlines()
    assert remarks[0].startswith("name,quantity,depth_m,width_m,height_m,falls or goes too far")
    assert remarks[1].startswith(f"shelf,8,0.32,0.9,1.8,{100 * shelf['share']:.0f},")
    assert remarks[2].startswith("'=cmd")
    table = client.get(f"/api/assess/{job}/results.csv")
    assert "attachment" in table.headers["content-disposition"]
    assert "'=cmd" in table.text
    report = client.get(f"/api/assess/{job}/report.html")
    assert report.headers["content-security-policy"].startswith("sandbox;")
    assert "shelf" in report.text
    assert client.get(f"/api/assess/{job}/run.json").status_code == 404
    assert client.get(f"/api/assess/{job}/../../etc").status_code == 404


def test_a_list_is_assessed_in_its_building(client: httpx.Client) -> None:
    """Upper floors are shaken more strongly: the same thing falls more often there."""
    text = "name,depth_m,width_m,height_m,floor\nlow,0.5,0.9,1.8,0\nhigh,0.5,0.9,1.8,3\n"
    asked = {"text": text, "planar": True, "suite": "fema-p695-near-field-pulse"}
    shares = []
    for building in (None, {"storeys": 3, "structure": "masonry"}):
        job = client.post("/api/assess", json={**asked, "building": building}).json()["id"]
        assert ended(client, job) == {"state": "done"}
        objects = client.get(f"/api/assess/{job}").json()["objects"]
        shares.append({each["name"]: each["share"] for each in objects})
    assert shares[0]["high"] == shares[0]["low"] == shares[1]["low"] < shares[1]["high"]
    wrong = {**asked, "building": {"storeys": 3, "structure": "straw"}}
    assert client.post("/api/assess", json=wrong).status_code == 422


CURVE = b"PGA [g],annual rate of exceedance\n0.01,0.1\n0.1,0.01\n1.0,0.001\n"


def test_a_list_is_shaken_as_strongly_as_its_site(client: httpx.Client) -> None:
    """The curve is a straight line in logarithms: once in T years 0.001 T of 1 g, by hand."""
    found = client.put("/api/hazard", params={"name": "mine.csv"}, content=CURVE).json()["levels"]
    assert [each["years"] for each in found] == [72, 475]  # the curve ends before 2,475
    assert found[1]["value"] == pytest.approx(0.475 * 9.80665)
    assert found[1]["in_words"] == "PGA 0.48 g"
    near = "fema-p695-near-field-pulse"
    asked = {"text": LIST, "planar": True, "suite": near}
    falls = {}
    for level in (0, 1):
        given = {key: found[level][key] for key in ("measure", "value")}
        question = {**asked, "level": {**given, "said": "once in some years"}}
        job = client.post("/api/assess", json=question).json()["id"]
        assert ended(client, job) == {"state": "done"}
        objects = client.get(f"/api/assess/{job}").json()["objects"]
        falls[level] = next(each["share"] for each in objects if each["name"] == "shelf")
    assert falls[0] < falls[1]
    report = client.get(f"/api/assess/{job}/report.html").text
    assert "once in some years. Each recording is scaled to that level" in report
    motions = [m.scaled(0.475 * 9.80665 / m.peak_ground_acceleration) for m in suite(near)]
    by_hand = simulate_many(
        [Body.rectangle(0.32, 1.8)], motions, model=Rocking(), progress=False
    )["outcome"]  # fmt: skip
    assert falls[1] == pytest.approx(float((by_hand != 0).mean()))
    for wrong in ({"measure": "D5-95", "value": 3.0}, {"measure": "PGA", "value": -1.0}):
        assert client.post("/api/assess", json={**asked, "level": wrong}).status_code == 422
    told = client.put("/api/hazard", params={"name": "a.csv"}, content=b"nothing")
    assert told.status_code == 422
    assert "a.csv" in told.json()["detail"]


def test_an_assessment_is_stopped_or_refused(client: httpx.Client) -> None:
    job = client.post("/api/assess", json={"text": LIST}).json()["id"]
    assert client.delete(f"/api/assess/{job}").status_code == 204
    assert ended(client, job) == {"state": "stopped"}
    assert client.get(f"/api/assess/{job}").status_code == 404
    wrong = client.post("/api/assess", json={"text": "name,height_m\nshelf,-2\n"}).json()["id"]
    told = ended(client, wrong)
    assert told["state"] == "failed"
    assert "shaketable-" not in str(told["detail"])
    assert client.get("/api/assess/nothing/events").status_code == 404
