"""Google Benchmark's files, and tables as text."""
import json
from statistics import median

UNIT_RAYS = 10e6  # camera rays in the unit of work U

class Runs:
    def __init__(self, folder, groups):
        self.repetitions = {}  # of each benchmark
        for file in (folder / f"{group}.json" for group in groups):
            for run in json.loads(file.read_text()).get("benchmarks", []) if file.exists() else []:
                if run["run_type"] == "iteration":
                    name = run["run_name"].split("/process_time")[0].split("/iterations:")[0]
                    self.repetitions.setdefault(name, []).append(run)

    def __contains__(self, name):
        return name in self.repetitions

    def value(self, name, key):
        return median(run[key] for run in self.repetitions[name])

    def cases(self, prefix):
        """Names below a prefix such as "group/case", by rising number at their end."""
        return sorted((name for name in self.repetitions if name.startswith(prefix + "/")),
                      key=lambda name: int(name.rsplit("/", 1)[1]))


def aligned(rows):
    """The first column to the left, the others to the right."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return "\n".join(
        "  ".join([row[0].ljust(widths[0])] + [c.rjust(w) for c, w in zip(row[1:], widths[1:])]).rstrip() for row in rows)
