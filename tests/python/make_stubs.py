# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints furrow/__init__.pyi, made of the keywords that the module tells:

    PYTHONPATH=build/release/python python3 tests/python/make_stubs.py > python/src/furrow/__init__.pyi
"""
import inspect
import sys

import furrow
from furrow import _furrow

COMMAND = ("PYTHONPATH=build/release/python python3 tests/python/make_stubs.py "
           "> python/src/furrow/__init__.pyi")
HEAD = '''# SPDX-License-Identifier: GPL-3.0-or-later
# Made by tests/python/make_stubs.py; a test fails where it is not as that makes it.
import os
from typing import Any, Callable, Iterator, List, Literal, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

Path = Union[str, "os.PathLike[str]"]
Strokes = Union[Path, Sequence[Mapping[str, Any]]]
Garment = Union["Mesh", Path]
Scene = Union["Mesh", Path, Mapping[str, Any]]
Progress = Callable[[str, float], object]
Cancel = Callable[[], bool]
Watch = Callable[[float, NDArray[np.float64]], object]

__version__: str

class ContentError(Exception): ...
class Cancelled(Exception): ...
class TooMuchWork(ValueError): ...

class FurrowWarning(UserWarning):
    code: str
    where: str
    help: str
    def __init__(self, text: str, code: str = "", where: str = "", help: str = "") -> None: ...

class FailureWarning(FurrowWarning): ...

class Columns:
    def __getitem__(self, name: str) -> NDArray[Any]: ...
    def __setitem__(self, name: str, values: ArrayLike) -> None: ...
    def __contains__(self, name: object) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def keys(self) -> List[str]: ...

class Mesh:
    name: str
    group_names: List[str]
    material_names: List[str]
    def __init__(self, V: ArrayLike, F: Union[ArrayLike, Sequence[Sequence[int]]], *, name: str = "") -> None: ...
    @property
    def V(self) -> NDArray[np.float64]: ...
    @V.setter
    def V(self, positions: ArrayLike) -> None: ...
    @property
    def F(self) -> NDArray[np.int32]: ...
    @property
    def E(self) -> NDArray[np.int32]: ...
    @property
    def vertex(self) -> Columns: ...
    @property
    def face(self) -> Columns: ...
    @property
    def edge(self) -> Columns: ...
    @property
    def corner(self) -> Columns: ...
    @property
    def repairs(self) -> Mapping[str, int]: ...
    def copy(self) -> Mesh: ...
    def write(self, path: Path, *, unit: Optional[str] = None, up: Optional[str] = None) -> None: ...

class Result:
    job: str
    report: dict[str, Any]
    meshes: List[Mesh]
    succeeded: bool
    failures: List[FailureWarning]
    @property
    def mesh(self) -> Optional[Mesh]: ...

def read_mesh(path: Path, *, unit: Optional[str] = None, up: Optional[str] = None) -> Mesh: ...
def info(mesh: Garment, *, unit: Optional[str] = None, up: Optional[str] = None) -> dict[str, Any]: ...
def from_meshio(mesh: Any, name: str = "") -> Mesh: ...
def to_meshio(mesh: Mesh) -> Any: ...'''

# Of the inputs that take more than a mesh or its file.
INPUTS = {"simulate": "Scene", "drape": "Union[Scene, Sequence[Scene]]", "keep": "Scene", "chart": "Scene",
          "fit": "Union[Garment, Sequence[Garment]]"}


def annotation(text):
    parts = text.split(" | ")
    return f"Optional[{text}]" if len(parts) == 1 else f"Union[{', '.join(parts)}, None]"


def sequences(text):
    """Alternatives within brackets, as in Sequence[str | int]."""
    return text.replace("Sequence[str | int]", "Sequence[Union[str, int]]").replace(
        "Sequence[Mesh | Path]", "Sequence[Garment]").replace("Mesh | Path", "Garment")


def stub(job):
    words = {name: kind for name, kind, _ in _furrow.keywords(job)}
    lines = []
    for name, parameter in inspect.signature(getattr(furrow, job)).parameters.items():
        if parameter.kind is parameter.KEYWORD_ONLY:
            lines += [] if "*," in lines else ["*,"]
            lines.append(f"{name}: {annotation(sequences(words[name]))} = None,")
        else:
            kind = "Strokes" if name == "strokes" else INPUTS.get(job, "Garment")
            optional = parameter.default is None
            lines.append(f"{name}: {f'Optional[{kind}] = None' if optional else kind},")
    return f"def {job}(\n    " + "\n    ".join(lines) + "\n) -> Result: ..."


def text():
    return "\n".join([HEAD] + [stub(job) for job in furrow._JOBS]) + "\n"


if __name__ == "__main__":
    sys.stdout.write(text())
