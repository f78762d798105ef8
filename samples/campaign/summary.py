#!/usr/bin/env python3
"""summary.py TABLE.csv PAGE.html RESULT.json...: all results of a campaign in one table and one page.

A row for each material and channel of each result, which is named after the folder it is in.
Values in 1/mm; std is one standard deviation. Files appear complete or not at all.
"""
import csv
import html
import io
import json
import os
import sys

COLUMNS = ["measurement", "material", "channel", "model", "verdict",
           "sigma_s_prime_per_mm", "sigma_s_prime_std_per_mm", "sigma_a_per_mm", "sigma_a_std_per_mm",
           "reasons"]


def rows(path):
    with open(path, encoding="utf-8") as file:
        result = json.load(file)
    for r in result["results"]:
        s, a = r["sigma_s_prime_per_mm"], r["sigma_a_per_mm"]
        yield [os.path.basename(os.path.dirname(path)), r["material"], r["channel"], r["model"], r["verdict"],
               s["value"], s["std"], a["value"], a["std"], "; ".join(r["reasons"])]


def cell(value):
    if value is None:
        return ""
    return f"{value:.5g}" if isinstance(value, float) else str(value)


def page(table):
    head = "".join(f"<th>{html.escape(name)}</th>" for name in COLUMNS)
    body = "\n".join(
        f'<tr class="{html.escape(row[4])}">' + "".join(f"<td>{html.escape(cell(v))}</td>" for v in row) + "</tr>"
        for row in table)
    refused = sum(row[4] != "ok" for row in table)
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Campaign</title>
<style>
body {{ font: 15px/1.4 system-ui, sans-serif; margin: 1em; color: #222; background: #fff; }}
.wide {{ overflow-x: auto; }}
table {{ border-collapse: collapse; }}
th, td {{ text-align: left; padding: .2em .6em; border-bottom: 1px solid #ddd; vertical-align: top; }}
td:nth-child(n+6):nth-child(-n+9) {{ text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }}
tr.refused {{ background: #fbeaea; }}
</style></head><body>
<h1>Campaign</h1>
<p>{len(table)} values, {refused} refused. sigma_s' and sigma_a in 1/mm with one standard deviation.</p>
<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>
{body}
</tbody></table></div>
</body></html>
"""


def write(path, text):
    pending = path + ".pending"
    with open(pending, "w", encoding="utf-8", newline="") as file:
        file.write(text)
    os.replace(pending, path)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    table = [row for path in sys.argv[3:] for row in rows(path)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    writer.writerows(["" if v is None else v for v in row] for row in table)
    write(sys.argv[1], text.getvalue())
    write(sys.argv[2], page(table))


if __name__ == "__main__":
    main()
