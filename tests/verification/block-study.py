# ranks: 1
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Moraine authors
# The study of the contained block, at two angles and one cell size: the error
# of the weighted basis is that of its band width, Nitsche's methods and a
# penalty with reaction have round-off only.
import csv

result = run("prm/cortis-2017/block-study.prm",
             {"Constants/angle": "{{0|30}}", "Mesh/Cell size": 10},
             command="study")
with open(result.folder / "study.csv") as file:
    rows = list(csv.DictReader(file))
text("rows", len(rows))
text("all ended well", all(row["status"] == "ok" for row in rows))
without = {}
for row in rows:
    band = row["Constants/band"]
    name = f"{row['Series']}, {row['Constants/angle']} degrees"
    error = float(row["error"])
    if row["Series"] == "weighted, no reaction":
        number(f"{name}, band {band}", error, 1)
        without[row["Constants/angle"], band] = error
    elif row["Series"] != "weighted":
        bound(name, error, 1e-10)
    elif row["Constants/angle"] == "0":
        bound(f"{name}, band {band}", error, 1e-10)
    elif float(band) == 0.1:
        # So wide a band does not hold at this angle.
        at_least(f"{name}, band {band}", error, 0.1)
    elif float(band) >= 1e-6:
        # Repeated solutions stop where they gain less than a factor of 2.
        bound(f"{name}, band {band}, over that without reaction",
              error / without["30", band], 0.1)
    else:
        bound(f"{name}, band {band}", error, 1e-8)
