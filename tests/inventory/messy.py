"""Twenty lists as hospitals, museums, schools and laboratories keep them, in five languages.

Each is made up, after what such lists look like: titles, merged headings, units in other places,
totals, notes, second tables, several sheets, words in place of numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from openpyxl import Workbook

Rows = Sequence[Sequence[object]]


class Messy(NamedTuple):
    """A list and what is to be understood of it.

    Attributes:
        name: of its file.
        sheets: rows of each sheet, by its name; "" for a text file.
        objects: how many are in it.
        first: name, depth, width, height [m] and mass [kg] of the first; None for what is not said.
        told: words that a remark has to have.
        answers: the file that answers what is asked at the first reading, if anything is.
        sheet: its name, where it is asked.
        asked: words of the refusal at the first reading.
        merge: ranges to be merged.
    """

    name: str
    sheets: dict[str, Rows]
    objects: int
    first: tuple[str, float | None, float | None, float, float | None]
    told: tuple[str, ...] = ()
    answers: str = ""
    sheet: str | None = None
    asked: str = ""
    merge: tuple[str, ...] = ()

    def write(self, folder: Path) -> Path:
        """Its file in a folder."""
        path = folder / self.name
        if path.suffix == ".csv":
            ((rows),) = self.sheets.values()
            lines = [";".join("" if each is None else str(each) for each in row) for row in rows]
            path.write_text("\n".join(lines) + "\n", encoding="utf-8")
            return path
        book = Workbook()
        for number, (title, rows) in enumerate(self.sheets.items()):
            sheet = book.worksheets[0] if not number else book.create_sheet()
            sheet.title = title
            for row in rows:
                sheet.append(list(row))
        for each in self.merge:
            book.worksheets[0].merge_cells(each)
        book.save(path)
        return path


MESSY = (
    Messy("station.csv", {"": [
        ("Inventarliste Station 4B",), ("Alle Maße in cm",), (),
        ("Gegenstand", "Tiefe", "Breite", "Höhe", "Gewicht", "Rollen"),
        ("Medikamentenschrank", 45, 90, 190, 80, "keine"),
        ("Sauerstoffflasche", "", "", "", "", ""),
        ("Verbandwagen", 50, 60, 95, "ca. 35", "frei"),
        ("Summe", "", "", "", 115, ""),
    ]}, 2, ("Medikamentenschrank", 0.45, 0.9, 1.9, 80.0),
        ("1 not assessed, as the list does not give their sizes: 'Sauerstoffflasche' (line 6)",)),
    Messy("station2.csv", {"": [
        ("Inventarliste Station 4B",), ("Alle Maße in cm",), (),
        ("Gegenstand", "Tiefe", "Breite", "Höhe", "Gewicht", "Rollen"),
        ("Medikamentenschrank", 45, 90, 190, 80, "keine"),
        ("Verbandwagen", 50, 60, 95, "ca. 35", "frei"),
        ("Summe", "", "", "", 115, ""),
    ]}, 2, ("Medikamentenschrank", 0.45, 0.9, 1.9, 80.0),
        ("in cm, as 'Alle Maße in cm' says", "'ca. 35' is taken as 35", "as totals: line 7")),
    Messy("labor.xlsx", {"Geräte": [
        ("Labor 2.14", None, None, None, None),
        ("Bezeichnung", "Maße [mm]", None, None, "Masse [kg]"),
        (None, "Breite", "Tiefe", "Höhe", None),
        ("Zentrifuge", 400, 550, 350, 42), ("Gasflasche N2", 230, 230, 1600, "65–75"),
    ]}, 2, ("Zentrifuge", 0.55, 0.4, 0.35, 42.0), ("'65–75' is taken as 75",),
        merge=("A1:E1", "A2:A3", "B2:D2", "E2:E3")),
    Messy("schule.csv", {"": [
        ("Gegenstand", "Länge", "Breite", "Höhe", "Anzahl", "Raum"),
        ("", "cm", "cm", "cm", "", ""),
        ("Regal", 90, 30, 200, 6, "R 101"), ("Lehrerpult", 140, 70, 75, 1, "R 101"),
    ]}, 2, ("Regal", 0.3, 0.9, 2.0, None), ("'Länge' is taken for 'depth'",)),
    Messy("museum_de.csv", {"": [
        ("Kulturgut", "Tiefe (cm)", "Breite (cm)", "Höhe (cm)", "Bemerkung"),
        ("Vitrine", "60", "60", "190", "geprüft"), ("Sockel", "40", "40", "110", ""),
        ("* Leihgaben sind nicht aufgeführt",),
    ]}, 2, ("Vitrine", 0.6, 0.6, 1.9, None), ("notes and headings: line 4",),
        answers='[columns]\nKulturgut = "name"\n', asked="no column for the name"),
    Messy("sala.csv", {"": [
        ("Hospital Regional · Inventario", ""), ("Medidas en cm",),
        ("Equipo", "Fondo", "Ancho", "Alto", "Peso (kg)", "Anclado"),
        ("Estante de insumos", 40, 90, 180, 60, "no"),
        ("Refrigerador", 65, 60, 175, "?", "sí"),
        ("Total", "", "", "", "", ""),
    ]}, 2, ("Estante de insumos", 0.4, 0.9, 1.8, 60.0), ("'?' cannot be read", "as totals")),
    Messy("bodega.csv", {"": [
        ("Nombre del equipo", "Profundidad (mm)", "Anchura (mm)", "Altura total (mm)", "Cantidad",
         "Ubicación"),
        ("Casillero", 500, 380, 1800, 12, "Pasillo"), ("Gabinete", 450, 900, 1000, 2, "Bodega"),
        ("Nombre del equipo", "Profundidad (mm)", "Anchura (mm)", "Altura total (mm)", "Cantidad",
         "Ubicación"),
        ("Biblioteca", 300, 800, 2000, 3, "Sala 2"),
    ]}, 3, ("Casillero", 0.5, 0.38, 1.8, None), ("as the header again: line 4",)),
    Messy("museo.xlsx", {"Vitrinas": [
        ("Nombre", "Fondo cm", "Ancho cm", "Alto cm", "Sala"),
        ("Vitrina 1", 50, 50, 180, "Sala A"), ("Vitrina 2", 50, 50, 180, None),
        ("Jarrón", 30, 30, 60, "Sala B"),
    ]}, 3, ("Vitrina 1", 0.5, 0.5, 1.8, None), merge=("E2:E3",)),
    Messy("colegio.xlsx", {"2024": [
        ("Objeto", "Fondo (m)", "Ancho (m)", "Alto (m)"), ("Estante", 0.3, 0.9, 1.8),
    ], "2025": [
        ("Objeto", "Fondo (m)", "Ancho (m)", "Alto (m)"), ("Estante", 0.3, 0.9, 1.8),
        ("Locker", 0.5, 0.4, 1.8),
    ]}, 2, ("Estante", 0.3, 0.9, 1.8, None), sheet="2025",
        asked="'2025' has the most rows, 2; name it by"),
    Messy("reparto.csv", {"": [
        ("Apparecchiatura", "Profondità [cm]", "Larghezza [cm]", "Altezza [cm]", "Massa [kg]",
         "Ruote", "Fissato"),
        ("Armadio farmaci", 45, 100, 200, 90, "nessuna", "sì"),
        ("Carrello medicazione", 50, 65, 100, 30, "libere", "no"),
        ("Totale", "", "", "", 120, "", ""),
    ]}, 2, ("Armadio farmaci", 0.45, 1.0, 2.0, 90.0), ("as totals: line 4",)),
    Messy("laboratorio.csv", {"": [
        ("Tutte le misure in mm",), ("Oggetto", "Profondità", "Larghezza", "Altezza", "Quantità"),
        ("Incubatore", 600, 700, 900, 2), ("Bombola azoto", 230, 230, 1500, 4),
        ("Nota: le bombole sono legate",),
    ]}, 2, ("Incubatore", 0.6, 0.7, 0.9, None), ("in mm, as 'Tutte le misure in mm'", "notes")),
    Messy("scuola.xlsx", {"Inventario": [
        ("Oggetto", "Dimensioni (cm)", None, None, "Stanza"),
        (None, "Lunghezza", "Larghezza", "Altezza", None),
        ("Libreria", 90, 35, 210, "1A"), ("Cattedra", 160, 70, 76, "1A"),
    ]}, 2, ("Libreria", 0.35, 0.9, 2.1, None), merge=("B1:D1", "E3:E4")),
    Messy("byoin.csv", {"": [
        ("病院備品一覧",), ("寸法単位：cm",),
        ("品名", "奥行", "幅", "高さ", "重量", "キャスター", "固定"),
        ("薬品棚", "４５", 90, 190, 80, "なし", "なし"),
        ("回診車", 50, 60, 95, "約35", "ロック", "なし"), ("合計", "", "", "", 115, "", ""),
    ]}, 2, ("薬品棚", 0.45, 0.9, 1.9, 80.0), ("'約35' is taken as 35", "as totals: line 6")),
    Messy("kenkyu.csv", {"": [
        ("機器名", "幅(㎜)", "奥行き(㎜)", "高さ(㎜)", "質量(㎏)", "設置場所", "台数"),
        ("遠心機", 400, 550, 350, 42, "実験室", 1), ("冷凍庫", 700, 800, 1980, 210, "実験室", 2),
    ]}, 2, ("遠心機", 0.55, 0.4, 0.35, 42.0)),
    Messy("hakubutsukan.xlsx", {"展示": [
        ("名称", "直径 cm", "高さ cm", "備考"), ("花瓶", 30, 60, ""), ("壺", "35〜40", 45, "複製"),
    ]}, 2, ("花瓶", 0.3, 0.3, 0.6, None), ("'35〜40' is taken as 35",)),
    Messy("ward.csv", {"": [
        ("Ward 3 equipment list (all dimensions in mm)",),
        ("Item", "Depth", "Width", "Heigth", "Weight kg", "Last service"),
        ("Drug cabinet", 450, 900, 1900, 80, "2026-01-05"),
        ("Fridge", "600-650", 600, 1850, "approx. 70", "n/a"), ("TOTAL", "", "", "", 150, ""),
    ]}, 2, ("Drug cabinet", 0.45, 0.9, 1.9, 80.0),
        ("'Heigth' is taken for 'height'", "'600-650' is taken as 600",
         "'approx. 70' is taken as 70")),
    Messy("lab.xlsx", {"Readme": [("How to fill in this list",)], "Equipment": [
        ("Name", "Length (in)", "Width (in)", "Height (in)", "Wt (lb)", "On wheels"),
        ("Centrifuge", 22, 16, 14, 92, "no"), ("Cart", 30, 18, 36, 60, "locked"),
    ]}, 2, ("Centrifuge", 16 * 0.0254, 22 * 0.0254, 14 * 0.0254, 92 * 0.45359237),
        ("sheets that are not read: 'Readme'", "'Length (in)' is taken for 'depth'")),
    Messy("museum.csv", {"": [
        ("Object", "D (cm)", "W (cm)", "H (cm)", "Note"), ("Showcase", 60, 60, 190, "glass"),
        ("Plinth", 40, 40, 110, ""), (), ("Loans", "Owner", "Until", "", ""),
        ("Bust", "City museum", "2027", "", ""),
    ]}, 2, ("Showcase", 0.6, 0.6, 1.9, None), ("'Loans' (line 5), 'Bust' (line 6)",)),
    Messy("school.csv", {"": [
        ("Name", "Depth m", "Width m", "Height m", "Quantity", "Room"),
        ("Bookcase", 0.3, 0.9, 1.8, 10, "Library"), ("Locker", 0.5, 0.4, 1.8, 40, "Hall"),
        (), ("Name", "Depth m", "Width m", "Height m", "Price"), ("Old shelf", 0.3, 0.8, 1.5, 20),
    ]}, 2, ("Bookcase", 0.3, 0.9, 1.8, None), ("another table, to the end: line 5",)),
    Messy("servers.csv", {"": [
        ("Equipment", "Base depth (ft)", "Base width (ft)", "Overall height (ft)", "Mass (t)",
         "Anchored"),
        ("Server rack", 3, 2, 6.5, 0.6, "bolted"), ("UPS", 2.5, 2, 5, "0.45", "unknown"),
    ]}, 2, ("Server rack", 0.9144, 0.6096, 6.5 * 0.3048, 600.0), ("'unknown' cannot be read",)),
)  # fmt: skip
