"""Shared parts of the jobs on whole data sets: files that are whole or not there, tasks in this process or by Ray."""

import os
import resource


def write_whole(path, write):
    """Writes a file under another name and renames it, so that no reader and no later run finds half of one."""
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        write(part)
        with open(part, "rb") as file:
            os.fsync(file.fileno())
        os.replace(part, path)
    except OSError as error:
        raise OSError(f"{path}: {error.strerror or error}") from None
    finally:
        part.unlink(missing_ok=True)


def peak():
    """The most memory that this process has had, in KiB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def each(function, paths, processes=None):
    """The dict that a function gives for every path, in their order: in this process, or by so many processes of Ray."""
    paths = [str(path) for path in paths]
    if not processes:
        return [function(path) for path in paths]
    try:
        import ray
    except ImportError as error:
        raise SystemExit(f"{error}: pip install 'ray[data]'") from None
    import geograd.ray

    if not ray.is_initialized():
        ray.init(num_cpus=processes, include_dashboard=False, logging_level="error", log_to_driver=False)
        ray.data.DataContext.get_current().enable_progress_bars = False
    return geograd.ray.Files(function).run(paths) if paths else []


def said(error):
    """The last line of a message: that of a worker of Ray ends a traceback."""
    return str(error).strip().splitlines()[-1]
