"""Sweeps by workers of Dask, one task for each shard: what the process that asks for a sweep does, and what the workers do."""

from __future__ import annotations

import contextlib
import hashlib
import itertools
import os
import re
import tempfile
import time
import tomllib
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import unripple
from unripple import _call, _labels, _values
from unripple._errors import InputError, OptionError, UnrippleError, WorkError
from unripple._progress import Telling, chosen_threads
from unripple._report import Report

#: Most shards that the scheduler has at a time, of each of which it keeps some kilobytes.
_AT_ONCE = 10_000

#: How often Dask tries a shard again that ended in an error, such as one of a full disk.
_RETRIES = 5

#: How long it may take, in s, until rows of a worker are seen here: file systems of networks keep what they know for a while.
_PATIENCE = 30.0


def sweep(plan: Any, output: Any, options: Mapping[str, Any], shards: Sequence[int] | None = None) -> Report:
    """Compute the rows of a sweep by the workers of ``options["client"]``, and the table here; see :func:`unripple.sweep`.

    With ``shards`` the workers compute these alone; whatever else is missing is computed here.
    """
    given = {name: value for name, value in options.items() if value is not None}
    distributed, client = _labels.needed("distributed", "dask"), given.pop("client", None)
    if not isinstance(client, distributed.Client) or client.asynchronous:
        found = _values.shown(client)
        raise OptionError(f"client: expected a distributed.Client that is not asynchronous, found {found}")
    shared = _values.flag("shared", given.pop("shared", True))
    if "shard" in given:
        raise OptionError("sweep: expected one of client and shard, found both")
    counted = _call.report("sweep", {**given, "count": True, "progress": False}, plan=plan, output=output)
    if given.get("count"):
        return counted
    if output is not None:
        folder = Path(_values.path("output", output)).absolute()
        sent = _Sent(client, counted, folder, shared, chosen_threads(given.get("threads")) or 1)
        with Telling(given.get("progress")) as telling:
            telling.stage("designs")
            sent.compute(telling, shards)
    return _call.report("sweep", given, plan=plan, output=output)


class _Sent:
    """A sweep whose shards are sent to workers."""

    def __init__(self, client: Any, counted: Report, folder: Path, shared: bool, threads: int) -> None:
        self.client, self.folder, self.shards = client, folder, counted.shards
        plan: str = counted.run.files[0].path
        #: Texts and numbers for workers, as the arguments of their tasks.
        self.told = (counted.plan_sha256, unripple.__version__, threads)
        #: Where workers find the plan and put rows, unless both are sent.
        self.where = (plan, str(folder)) if shared else ()
        self.files = None if shared else _files(plan, counted)
        self.name = hashlib.sha256(repr((self.told, folder, shared)).encode()).hexdigest()[:16]

    def compute(self, telling: Telling, shards: Sequence[int] | None) -> None:
        """Have all missing shards, or those of some, computed; those whose workers were killed once more, after the others."""
        wanted = range(self.shards) if shards is None else set(shards)
        killed = [shard for shard in self._missing() if shard in wanted]
        for suffix in ("", "-again"):
            killed = self._round(killed, suffix, telling) if killed else []
        if killed:
            raise WorkError(
                f"sweep: shards whose workers were killed again and again: {len(killed)}, the first of them shard {killed[0]}; the command "
                "`unripple sweep` finds the designs that end their process, and makes rows of them"
            )

    def _missing(self) -> list[int]:
        """Return the shards without rows; none if the folder is of something else, which the task then refuses in its own words."""
        kept, own = self.folder / "plan.json", (".plan.json.", "parts")
        if kept.exists():
            foreign = f'"{self.told[0]}"' not in kept.read_text(encoding="utf-8", errors="replace")
        else:
            others = (path for path in self.folder.glob("*") if not path.name.startswith(own))
            foreign = any(others) or any(self.folder.glob("parts/*"))
        done = {path.name for path in self.folder.glob("parts/*.jsonl")}
        return [] if foreign else [shard for shard in range(self.shards) if f"{shard}.jsonl" not in done]

    def _round(self, shards: list[int], suffix: str, telling: Telling) -> list[int]:
        """Have some shards computed; return those of which Dask says that their workers were killed."""
        from distributed import CancelledError, KilledWorker, as_completed
        from distributed.comm.core import CommClosedError

        waiting, killed, done, before = iter(shards), list[int](), 0, self.shards - len(shards)
        running: dict[str, tuple[int, Any]] = {}
        submit = partial(self.client.submit, pure=False, retries=_RETRIES)
        ended: Any = as_completed(loop=self.client.loop)  # type: ignore[no-untyped-call]
        files: Any = None
        try:
            while done + len(killed) < len(shards):
                for shard in itertools.islice(waiting, _AT_ONCE - len(running)):
                    if self.client.status != "running":
                        raise CancelledError(f"the client is {self.client.status}")
                    if self.files and files is None:
                        files = submit(dict, self.files, key=f"unripple-plan-{self.name}")
                    key = f"unripple-sweep-{self.name}{suffix}-{shard}"
                    task, where = (_part, (files,)) if files else (_shard, self.where)
                    running[key] = shard, submit(task, *where, shard, *self.told, key=key)
                    ended.add(running[key][1])
                future = next(ended)
                if future.cancelled():
                    raise CancelledError(future.key)
                shard, error = running[future.key][0], future.exception()
                if isinstance(error, KilledWorker):
                    killed.append(shard)
                elif error is not None:
                    raise WorkError(f"sweep: shard {shard}: {error}")
                else:
                    self._take(shard, future.result() if files else None)
                    done += 1
                del running[future.key]
                telling.done((before + done) / self.shards)
        except (CancelledError, CommClosedError) as error:
            raise WorkError(
                f"sweep: {before + done} of {self.shards} shards are done; the scheduler of Dask was lost, or tasks were cancelled ({error}); "
                "with the client of a scheduler that runs, the same call goes on where it was"
            ) from None
        finally:
            # A client that is closed has nothing to cancel.
            with contextlib.suppress(Exception):
                self.client.cancel([future for _, future in running.values()])
        return killed

    def _take(self, shard: int, files: tuple[bytes, bytes] | None) -> None:
        """Put the rows of a shard in place, or see that its worker has."""
        part = self.folder / f"parts/{shard}.jsonl"
        if files is not None:
            part.parent.mkdir(parents=True, exist_ok=True)
            for path, content in zip((self.folder / "plan.json", part), files, strict=True):
                if not path.exists():
                    _write(path, content)
        until = time.monotonic() + _PATIENCE
        while not part.exists():
            if time.monotonic() > until:
                expected = "expected a folder that all workers have by this path, or shared=False"
                raise WorkError(f"sweep: shard {shard} was written by a worker; {expected}, found no {part}")
            time.sleep(0.05)


def _files(plan: str, counted: Report) -> dict[str, bytes]:
    """Return the files that a plan is read from by their paths from its folder, its own first, and the folder that it names them from."""
    paths = [file.path for file in counted.run.files]
    text = Path(plan).read_text(encoding="utf-8")
    folder = _folder(text)
    # Libraries, and files by the whole of their paths, which would not be where workers put them.
    away = [path for path in paths[1:] if os.path.isdir(path) or path in text or os.path.isabs(folder)]
    if away or os.path.isabs(counted.surface):
        expected = "built-in surfaces, or files by a path from the plan's folder, which workers are sent"
        raise InputError(f"{plan}: expected {expected}, found {[*away, counted.surface][0]}")
    files = {os.path.relpath(path, os.path.dirname(plan)): Path(path).read_bytes() for path in paths}
    # A folder, through which paths may lead that go up from it.
    return files if os.path.isabs(folder) else {**files, f"{folder}/": b""}


def _folder(text: str) -> str:
    """Return the folder that a plan names files from, relative to its own."""
    # Keys of the plan itself come before its tables, of which there may be many.
    for part in (re.split(r"^\s*\[", text, maxsplit=1, flags=re.MULTILINE)[0], text):
        with contextlib.suppress(tomllib.TOMLDecodeError):
            return str(tomllib.loads(part).get("folder", "."))
    return "."


def _write(path: Path, content: bytes) -> None:
    """Write a file that is complete and on the disk, or not there."""
    with tempfile.TemporaryDirectory(prefix=f".{path.name}.", dir=path.parent) as aside:
        with open(os.path.join(aside, "content"), "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(file.name, path)
    folder = os.open(path.parent, os.O_RDONLY)
    os.fsync(folder)
    os.close(folder)


def _shard(plan: str, output: str, shard: int, sha256: str, version: str, threads: int) -> None:
    """Compute a shard into a folder: a task of Dask. Its errors are Python's own, which every process can read."""
    if unripple.__version__ != version:
        raise RuntimeError(f"expected workers with unripple {version}, found {unripple.__version__}")
    try:
        report = unripple.sweep(plan, output, shard=shard, no_figures=True, progress=False, threads=threads)
    except UnrippleError as error:
        raise RuntimeError(str(error)) from None
    if report.plan_sha256 != sha256:
        raise RuntimeError(f"{plan}: expected the plan and the surface of the call ({sha256}), found others")


def _part(files: dict[str, bytes], shard: int, *told: Any) -> tuple[bytes, bytes]:
    """Compute a shard of a plan that is sent: a task of Dask. Return the files of the plan and of the rows in the folder of the sweep."""
    from distributed import get_worker

    with tempfile.TemporaryDirectory(dir=get_worker().local_directory) as folder:
        # As deep as any path goes up.
        base = Path(folder, *["down"] * max(path.count("..") for path in files), "plan")
        for name, content in files.items():
            path = Path(os.path.normpath(base / name))
            (path if name.endswith("/") else path.parent).mkdir(parents=True, exist_ok=True)
            if not name.endswith("/"):
                path.write_bytes(content)
        output = Path(folder, "output")
        _shard(str(base / next(iter(files))), str(output), shard, *told)
        return (output / "plan.json").read_bytes(), (output / f"parts/{shard}.jsonl").read_bytes()
