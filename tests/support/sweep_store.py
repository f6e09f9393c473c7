"""What the store of a sweep holds, for tests."""
import sqlite3

# What two sweeps that say the same may differ in.
TIMES = {"cpu_seconds", "seconds"}


def connect(path):
    return sqlite3.connect(f"file:{path}?mode=ro", uri=True)


def contents(path):
    """All that a store says but times and the numbers of names."""
    store = connect(path)
    store.row_factory = sqlite3.Row
    assert store.execute("PRAGMA integrity_check").fetchone()[0] == "ok"
    names = dict(store.execute("SELECT id, name FROM names"))

    def rows(table):
        out = []
        for row in store.execute(f"SELECT * FROM {table}"):
            row = {key: row[key] for key in row.keys() if key not in TIMES}
            if "observable" in row:
                row["observable"] = names[row["observable"]]
            out.append(tuple(sorted(row.items(), key=lambda item: item[0])))
        return sorted(out, key=repr)

    result = {table: rows(table)
              for table in ("sweep", "parameters", "scenes", "reference", "runs", "observables")}
    store.close()
    return result


def runs_in(path):
    """How many runs a store has; 0 of one that is not there yet."""
    try:
        store = connect(path)
        try:
            return store.execute("SELECT count(*) FROM runs").fetchone()[0]
        finally:
            store.close()
    except sqlite3.Error:
        return 0
