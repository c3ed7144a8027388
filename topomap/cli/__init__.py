"""The command line: what it is called with, and how it ends."""

from __future__ import annotations

import sys

__all__ = ["main", "run"]


def main(argv: list[str] | None = None) -> int:
    """Carry out one command.

    Parameters
    ----------
    argv : list of str, optional
        The arguments after the program's name; those of the process if None.

    Returns
    -------
    int
        0 done; 2 bad input or usage; 3 the job itself failed. The reason is one
        line on standard error, never a traceback.
    """
    import typer

    from topomap.cli.app import app
    from topomap.errors import InputError, JobError
    from worlds.errors import WorldError

    # typer exports the class of one usage error; its base stands for all.
    usage_error: type[Exception] = typer.BadParameter.__mro__[2]
    arguments = sys.argv[1:] if argv is None else argv
    command = typer.main.get_command(app)
    try:
        code = command.main(arguments, prog_name="topomap", standalone_mode=False)
    except JobError as error:
        return _fail(str(error), 3)
    except (InputError, WorldError) as error:
        return _fail(str(error), 2)
    except OSError as error:
        return _fail(f"{error.filename or 'file'}: {error.strerror or error}", 2)
    except usage_error as error:
        return _fail(getattr(error, "format_message", error.__str__)(), 2)
    except (typer.Abort, KeyboardInterrupt):
        return _fail("interrupted", 130)
    return code if isinstance(code, int) else 0


def run() -> None:
    """Run as the program `topomap`."""
    sys.exit(main())


def _fail(reason: str, code: int) -> int:
    """Say on one line why, and return the exit code."""
    if reason:
        sys.stderr.write(f"topomap: {' '.join(reason.split())}\n")
    return code
