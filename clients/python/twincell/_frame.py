"""Samples as a table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterable

if TYPE_CHECKING:
    import pandas


def frame(samples: Iterable[dict[str, Any]]) -> pandas.DataFrame:
    """A data frame with the controller's time [s] as index, one column a joint (`q1_rad`, …), `moving`, `safety` and `step`. Needs pandas."""
    import pandas

    rows = [
        {
            "time_s": sample["time_s"],
            **{f"q{i}_rad": q for i, q in enumerate(sample["q_rad"], start=1)},
            "moving": sample["moving"],
            "safety": sample["safety"],
            "step": sample["step"],
        }
        for sample in samples
    ]
    return pandas.DataFrame(rows).set_index("time_s") if rows else pandas.DataFrame()
