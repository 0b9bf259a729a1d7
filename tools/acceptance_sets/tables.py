# SPDX-License-Identifier: Apache-2.0
"""Markdown tables and the criteria that every set shares."""
import statistics

NOTHING = float("nan")


def median(values):
    values = list(values)
    return statistics.median(values) if values else NOTHING


def percent(flags):
    flags = list(flags)
    return 100.0 * sum(flags) / len(flags) if flags else NOTHING


def markdown(columns, rows):
    """First column to the left, the others to the right."""
    lines = ["| " + " | ".join(columns) + " |", "|---" + "|---:" * (len(columns) - 1) + "|"]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)


def number(value, digits=3):
    return "-" if value is None or value != value else f"{value:.{digits}g}"


def groups_of(outcomes):
    groups = {}
    for o in outcomes:
        groups.setdefault(o["group"], []).append(o)
    return groups


SUMMARY = ["set", "files", "proved (0)", "not proved (5)", "no contour (4)", "points",
           "raw extrema", "vertices", "lower bound", "vertices = bound", "largest move / tolerance", "ms",
           "longest ms", "process ms"]


def summary_row(name, outcomes):
    fitted = [o for o in outcomes if "vertices" in o]
    count = {code: sum(o["exit"] == code for o in outcomes) for code in (0, 4, 5)}
    least = percent(o["vertices"] == o["bound"] for o in fitted)
    cells = [name, len(outcomes), count[0], count[5], count[4]]
    cells += [number(median(o[key] for o in fitted), 4)
              for key in ("points", "raw", "vertices", "bound")]
    cells += ["-" if not fitted else f"{least:.0f} %",
              number(max((o["move"] for o in fitted), default=NOTHING)),
              number(1e3 * median(o["seconds"] for o in fitted)),
              number(1e3 * max((o["seconds"] for o in fitted), default=NOTHING)),
              number(1e3 * median(o["process_seconds"] for o in outcomes))]
    return cells


def summary(outcomes):
    """One row a group; points, raw extrema, vertices, bound and times are medians."""
    groups = groups_of(outcomes)
    rows = [summary_row(name, group) for name, group in groups.items()]
    if len(groups) > 1:
        rows.append(summary_row("all", outcomes))
    return markdown(SUMMARY, rows)


def common_criteria(outcomes):
    fitted = [o for o in outcomes if "vertices" in o]
    found = [("moves within the tolerance", f"{sum(o['moves_within'] for o in fitted)} of "
              f"{len(fitted)}", all(o["moves_within"] for o in fitted))]
    refused = [o for o in outcomes if o["exit"] == 4]
    if refused:
        named = [o for o in refused if o["explanation_holds"] is not None]
        found.append(("refused: a contour exists at the tolerance that the refusal names",
                      f"{sum(o['explanation_holds'] for o in named)} of {len(named)} "
                      f"({len(refused) - len(named)} name none)",
                      all(o["explanation_holds"] for o in named)))
    judged = [o for o in fitted if "judge_agrees" in o]
    if judged:
        found.append(("independent judge agrees (without asking for rounding at joints)",
                      f"{sum(o['judge_agrees'] for o in judged)} of {len(judged)} "
                      f"({sum(o['judge_agrees'] and o['judge_as_is'] for o in judged)})",
                      all(o["judge_agrees"] for o in judged)))
    return found


def all_proved(outcomes):
    proved = sum(o["exit"] == 0 for o in outcomes)
    return ("all proved", f"{proved} of {len(outcomes)}", proved == len(outcomes))


def criteria_table(criteria):
    return markdown(["criterion", "measured", "met"],
                    [(text, measured, "yes" if ok else "**no**")
                     for text, measured, ok in criteria])


# Columns of the table of single files: heading, key of the outcome, how to print it.
PER_FILE = [("file", "name", str), ("set", "group", str), ("exit", "exit", str),
            ("error", "error", str), ("points", "points", str), ("raw extrema", "raw", str),
            ("vertices", "vertices", str), ("lower bound", "bound", str),
            ("largest move / tolerance", "move", lambda v: f"{v:.3g}"),
            ("ms", "seconds", lambda v: f"{1e3 * v:.3g}"),
            ("process ms", "process_seconds", lambda v: f"{1e3 * v:.3g}")]


def per_file_text(outcomes):
    """Tab-separated values, a file a line."""
    lines = ["\t".join(heading for heading, _, _ in PER_FILE)]
    for o in outcomes:
        lines.append("\t".join(text(o[key]) if o.get(key) is not None else ""
                               for _, key, text in PER_FILE))
    return "\n".join(lines) + "\n"
