# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions of the package: each is also the built-in one that callers expect."""


class BadArgument(ValueError):
    """An argument breaks its rule; raised before any work. The message has value and rule."""


class ComputeFailed(RuntimeError):
    """The data do not allow an answer. The message says what was found and what was needed."""


class FileError(OSError):
    """A file or folder is missing, broken or cannot be written. The message names the file."""


for _error in (BadArgument, ComputeFailed, FileError):
    _error.__module__ = "pcl6d"  # as tracebacks print it
del _error
