"""Small spreadsheets that ask for memory without end: each is refused at once, with the limit."""

from __future__ import annotations

import io
import json
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from openpyxl import Workbook

SECONDS, GROWTH = 2.0, 200e6  # of the processor, and bytes, until each is refused
READER = """
import json, resource, sys, time
from pathlib import Path
from shaketable import InputError, read_inventory
for name in sys.argv[1:]:
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    begun = time.process_time()
    try:
        said = f"{len(read_inventory(Path(name)))} rows"
    except InputError as error:
        said = str(error)
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    print(json.dumps([said, time.process_time() - begun, 1024 * grown]), flush=True)
"""
SHEET, STYLES, BOOK = "xl/worksheets/sheet1.xml", "xl/styles.xml", "xl/workbook.xml"
ODS = "mimetypeapplication/vnd.oasis.opendocument.spreadsheet"
NAMES = (
    'xmlns:office="urn:oasis:names:tc:opendocument:xmlns:office:1.0" '
    'xmlns:table="urn:oasis:names:tc:opendocument:xmlns:table:1.0" '
    'xmlns:text="urn:oasis:names:tc:opendocument:xmlns:text:1.0"'
)


def excel(path: Path, part: str = "", old: str = "", new: str = "") -> Path:
    """A list as .xlsx, of which a part is changed."""
    book = Workbook()
    sheet = book.worksheets[0]
    for row in (["name", "depth_m", "width_m", "height_m"], ["shelf", 0.3, 0.8, 1.8]):
        sheet.append(row)
    plain = io.BytesIO()
    book.save(plain)
    with zipfile.ZipFile(plain) as before, zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as now:
        for name in before.namelist():
            text = before.read(name).decode()
            if name == part:
                assert old in text, text[:2000]
                text = text.replace(old, new, 1)
            now.writestr(name, text)
    return path


def open_document(path: Path, rows: str) -> Path:
    """Rows as .ods."""
    content = (
        f'<office:document-content {NAMES} office:version="1.3"><office:body><office:spreadsheet>'
        f'<table:table table:name="a">{rows}</table:table></office:spreadsheet></office:body>'
        "</office:document-content>"
    )
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("mimetype", ODS.removeprefix("mimetype"), zipfile.ZIP_STORED)
        file.writestr("content.xml", content)
        file.writestr("META-INF/manifest.xml", "<a/>")
    return path


def text_cells(*texts: str) -> str:
    return "".join(
        f'<table:table-cell office:value-type="string"><text:p>{text}</text:p></table:table-cell>'
        for text in texts
    )


def bombs(folder: Path) -> dict[Path, str]:
    """Files, with what is said of each."""
    merge = '<mergeCell ref="{}"/>'
    end = "</sheetData>"

    def merged(*ranges: str) -> str:
        return f"{end}<mergeCells>{''.join(map(merge.format, ranges))}</mergeCells>"

    some = folder / "entities.xlsx"
    entities = "".join(f'<!ENTITY a{k} "{f"&a{k - 1};" * 10 if k else "lol"}">' for k in range(10))
    head = text_cells("name", "width_m", "height_m")
    row, cell = "<table:table-row{}>{}</table:table-row>", "<table:table-cell{}/>"
    far = ' table:number-rows-repeated="{}"'
    wide = ' table:number-columns-repeated="{}"'
    body = text_cells("shelf", "0.3", "1.8")
    return {
        excel(folder / "merged.xlsx", SHEET, end, merged("A1:XFD1048576")): "cells are merged",
        excel(
            folder / "overlapping.xlsx", SHEET, end, merged(*[f"A1:Z{k + 900}" for k in range(900)])
        ): "cells are merged",
        excel(
            folder / "merges.xlsx", SHEET, end, merged(*[f"A{k}:B{k}" for k in range(1, 9000)])
        ): "1,000 elements mergeCell",
        excel(
            folder / "names.xlsx", BOOK, "<definedNames/>", "<definedNames>"
            + "".join(f'<definedName name="n{k}">1</definedName>' for k in range(300_000))
            + "</definedNames>",
        ): "1,000 elements definedName",
        excel(
            folder / "styles.xlsx", STYLES, "<cellXfs", "<cellXfs>" + "<xf/>" * 2_500_000
            + "</cellXfs><cellXfs",
        ): "70,000 elements xf",
        excel(
            folder / "rows.xlsx", SHEET, end, "<row r='3'><c r='A3'><v>1</v></c></row>" * 5_000_000
            + end,
        ): "unpacks to 195 MB; at most 20 MB",
        excel(
            some, SHEET, "<worksheet", f"<!DOCTYPE a [{entities}]><worksheet"
        ): "declares entities",
        excel(
            folder / "deep.xlsx", SHEET, end, "<a>" * 2_000_000 + "</a>" * 2_000_000 + end
        ): "100,000 elements a",
        open_document(
            folder / "rows.ods", row.format("", head) + row.format(far.format(2 * 10**9), body)
        ): "more than 200,000 rows",
        open_document(
            folder / "far.ods",
            row.format("", head) + row.format(far.format(2 * 10**9), cell.format(""))
            + row.format("", body),
        ): "more than 200,000 rows",
        open_document(
            folder / "wide.ods",
            row.format("", head) + row.format("", cell.format(wide.format(2 * 10**9)) + body),
        ): "more than 1,000 columns",
    }  # fmt: skip


def test_bombs_are_refused_at_once(tmp_path: Path) -> None:
    whole = {
        excel(tmp_path / "whole.xlsx"): "1 rows",
        open_document(
            tmp_path / "whole.ods",
            f"<table:table-row>{text_cells('name', 'width_m', 'height_m')}</table:table-row>"
            f"<table:table-row>{text_cells('shelf', '0.3', '1.8')}</table:table-row>"
            '<table:table-row table:number-rows-repeated="1048574"><table:table-cell '
            'table:number-columns-repeated="16384"/></table:table-row>',  # as LibreOffice writes
        ): "1 rows",
    }
    files = {**whole, **bombs(tmp_path)}
    run = subprocess.run(
        [sys.executable, "-c", READER, *map(str, files)], capture_output=True, text=True, check=True
    )
    told = [json.loads(line) for line in run.stdout.splitlines()]
    for (path, said), (found, seconds, grown) in zip(files.items(), told, strict=True):
        assert said in found, f"{path.name}: {found[:300]}"
        if path not in whole:  # which import what reads spreadsheets
            assert path.stat().st_size < 7e6
            assert seconds < SECONDS, path.name
            assert grown < GROWTH, path.name


@pytest.mark.parametrize("reference", ["", "A1", "B2:C7", "nonsense"])
def test_ranges_that_are_no_bomb(tmp_path: Path, reference: str) -> None:
    """What is no range counts as one cell."""
    from shaketable.tables.packed import _cells

    assert _cells(reference) == {"B2:C7": 12}.get(reference, 1)
