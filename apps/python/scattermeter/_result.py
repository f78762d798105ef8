"""The content of a result.json as Python objects."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, Union

from ._native import InputError

PathLike = Union[str, "os.PathLike[str]"]


class Result(Mapping[str, Any]):
    """The content of a result.json: a read-only mapping of plain dictionaries, lists and numbers.

    `results` has one entry per material and channel; sigma_s_prime_per_mm and sigma_a_per_mm in it
    have value, std and interval95, all in 1/mm, and upper_limit: whether only the upper end of the
    interval is of use; unknown numbers are None.
    """

    def __init__(self, content: Dict[str, Any]) -> None:
        self._content = content

    def __getitem__(self, key: str) -> Any:
        return self._content[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._content)

    def __len__(self) -> int:
        return len(self._content)

    def __eq__(self, other: object) -> bool:
        return dict(self) == (dict(other) if isinstance(other, Mapping) else other)

    def __repr__(self) -> str:
        lines = ["material  channel  sigma_s' /mm          sigma_a /mm            model      verdict"]
        for e in self._content["results"]:
            cells = []
            for key in ("sigma_s_prime_per_mm", "sigma_a_per_mm"):
                q = e[key]
                known = q["value"] is not None and q["std"] is not None
                if known and q.get("upper_limit"):
                    cells.append(f"< {q['interval95'][1]:.2g}")
                else:
                    cells.append(f"{q['value']:.5g} +- {q['std']:.2g}" if known else "-")
            lines.append(
                f"{e['material']:<9} {e['channel']:<8} {cells[0]:<21} {cells[1]:<22} "
                f"{e['model']:<10} {e['verdict']}"
            )
        return "\n".join(lines)

    def to_dict(self) -> Dict[str, Any]:
        """The content as plain dictionaries, as from json.loads() of the file."""
        return self._content

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with one row per material and channel (needs pandas).

        Columns: material, channel, model, verdict, reasons, eta; sigma_s_prime_per_mm and
        sigma_a_per_mm with _std, _low and _high (the 95 % interval), 1/mm; correlation.
        """
        import pandas

        rows: List[Dict[str, Any]] = []
        for e in self._content["results"]:
            row = {k: e.get(k) for k in ("material", "channel", "model", "verdict", "eta")}
            row["reasons"] = "; ".join(e.get("reasons", []))
            for key in ("sigma_s_prime_per_mm", "sigma_a_per_mm"):
                low, high = e[key].get("interval95") or (None, None)
                row[key] = e[key]["value"]
                row[key + "_std"] = e[key]["std"]
                row[key + "_low"], row[key + "_high"] = low, high
            row["correlation"] = e.get("correlation")
            rows.append(row)
        return pandas.DataFrame(rows)


def read_result(path: PathLike) -> Result:
    """The content of a result.json.

    Raises FileNotFoundError if there is no such file, InputError if it is not a result.
    """
    try:
        content = json.loads(Path(path).read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise
    except (OSError, ValueError) as error:
        raise InputError(f"{os.fspath(path)}: {error}") from error
    if not isinstance(content, dict) or not isinstance(content.get("results"), list):
        raise InputError(f"{os.fspath(path)}: results: is missing")
    return Result(content)


def values(result: Mapping[str, Any]) -> Dict[str, Dict[str, Dict[str, Any]]]:
    """Entries of a result by material and channel: values(result)["POM"]["R"]."""
    out: Dict[str, Dict[str, Dict[str, Any]]] = {}
    for entry in result["results"]:
        out.setdefault(entry["material"], {})[entry["channel"]] = entry
    return out
