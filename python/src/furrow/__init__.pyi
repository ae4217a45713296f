# SPDX-License-Identifier: GPL-3.0-or-later
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
def to_meshio(mesh: Mesh) -> Any: ...
def wrinkle(
    garment: Optional[Garment] = None,
    strokes: Optional[Strokes] = None,
    *,
    state: Optional[Path] = None,
    without: Union[str, Sequence[str], None] = None,
    fade: Optional[float] = None,
    output: Optional[Path] = None,
    inserted: Optional[Path] = None,
    smoothed: Optional[Path] = None,
    settle: Optional[bool] = None,
    subdivide: Union[int, Literal["auto"], None] = None,
    budget: Optional[float] = None,
    made_for: Optional[Path] = None,
    height: Optional[float] = None,
    width: Optional[float] = None,
    rule: Optional[Literal["fold", "safe", "paper"]] = None,
    rest: Optional[Literal["drawn", "copied", "flat", "keep"]] = None,
    max_distance: Optional[float] = None,
    region: Optional[Literal["two-ring", "whole-mesh"]] = None,
    detail: Optional[Literal["coarse", "normal", "fine"]] = None,
    fold_iterations: Optional[int] = None,
    flat_base: Optional[bool] = None,
    density: Optional[float] = None,
    max_weights: Optional[int] = None,
    iterations: Optional[int] = None,
    lambda_: Optional[float] = None,
    mu: Optional[float] = None,
    weights: Optional[Literal["uniform", "cotangent"]] = None,
    keep_lines: Optional[bool] = None,
    keep_border: Optional[bool] = None,
    fabric: Optional[Path] = None,
    membrane: Optional[Literal["paper", "uniform", "inverse", "van-gelder", "triangles", "tension", "patches"]] = None,
    bending_law: Optional[Literal["cross", "hinge", "cosine", "plate"]] = None,
    stretch: Optional[float] = None,
    rigidity: Optional[float] = None,
    tension: Optional[float] = None,
    stiffness: Optional[float] = None,
    friction: Optional[float] = None,
    gap: Optional[float] = None,
    gravity: Union[float, Sequence[float], None] = None,
    body: Optional[Garment] = None,
    body_unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    cache: Optional[Path] = None,
    pin_box: Union[Sequence[float], Sequence[Sequence[float]], None] = None,
    pin_loop: Union[str, int, Sequence[Union[str, int]], None] = None,
    pin_group: Union[str, Sequence[str], None] = None,
    pin_vertices: Union[int, Sequence[int], None] = None,
    settings: Optional[Mapping[str, Any]] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
def simulate(
    garment: Optional[Scene] = None,
    *,
    state: Optional[Path] = None,
    accuracy: Union[float, str, None] = None,
    budget: Optional[float] = None,
    outputs_below: Optional[Path] = None,
    times: Optional[bool] = None,
    watch: Optional[Watch] = None,
    output: Optional[Path] = None,
    save_state: Optional[Path] = None,
    checkpoint: Optional[float] = None,
    inserted: Optional[Path] = None,
    smoothed: Optional[Path] = None,
    settled: Optional[Path] = None,
    animation: Optional[Path] = None,
    save_body: Optional[Path] = None,
    fps: Optional[float] = None,
    seconds: Optional[float] = None,
    settle: Optional[bool] = None,
    stop_at: Optional[float] = None,
    density: Optional[float] = None,
    fabric: Optional[Path] = None,
    warp: Optional[Path] = None,
    membrane: Optional[Literal["paper", "uniform", "inverse", "van-gelder", "triangles", "tension", "patches"]] = None,
    bending_law: Optional[Literal["cross", "hinge", "cosine", "plate"]] = None,
    stretch: Optional[float] = None,
    rigidity: Optional[float] = None,
    tension: Optional[float] = None,
    stiffness: Optional[float] = None,
    bending: Optional[float] = None,
    line_stretch: Optional[float] = None,
    line_density: Optional[float] = None,
    damping: Optional[float] = None,
    drag: Optional[float] = None,
    friction: Optional[float] = None,
    cloth_friction: Optional[float] = None,
    gap: Optional[float] = None,
    gravity: Union[float, Sequence[float], None] = None,
    wind: Optional[Sequence[float]] = None,
    dt: Optional[float] = None,
    force_dt: Optional[bool] = None,
    integrator: Optional[Literal["auto", "leapfrog", "rk4", "xpbd", "implicit", "tr-bdf2"]] = None,
    sweeps: Optional[int] = None,
    self_contact: Optional[Literal["off", "on"]] = None,
    cloth_thickness: Optional[float] = None,
    threads: Optional[int] = None,
    subdivide: Optional[int] = None,
    allow_crossings: Optional[int] = None,
    rest: Optional[Literal["stored", "keep"]] = None,
    velocity: Optional[Sequence[float]] = None,
    body: Optional[Garment] = None,
    body_unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    body_frames: Optional[Path] = None,
    body_fps: Optional[float] = None,
    cache: Optional[Path] = None,
    tolerance: Optional[float] = None,
    gradient: Optional[Literal["exact", "interpolated"]] = None,
    pin_box: Union[Sequence[float], Sequence[Sequence[float]], None] = None,
    pin_loop: Union[str, int, Sequence[Union[str, int]], None] = None,
    pin_group: Union[str, Sequence[str], None] = None,
    pin_vertices: Union[int, Sequence[int], None] = None,
    settings: Optional[Mapping[str, Any]] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
def drape(
    garment: Union[Scene, Sequence[Scene]],
    *,
    output: Optional[Path] = None,
    animation: Optional[Path] = None,
    subdivide: Union[int, Literal["auto"], None] = None,
    finest: Optional[float] = None,
    bending_friction: Optional[float] = None,
    made_for: Optional[Path] = None,
    band: Optional[Mapping[str, float]] = None,
    band_stiffness: Optional[float] = None,
    self_contact: Optional[Literal["auto", "on", "off"]] = None,
    loose: Optional[Literal["hold", "drop", "fall"]] = None,
    budget: Optional[float] = None,
    touches: Optional[Path] = None,
    residual: Optional[float] = None,
    contact_depth: Optional[float] = None,
    cloth_thickness: Optional[float] = None,
    penetration: Optional[float] = None,
    plain: Optional[bool] = None,
    max_iterations: Optional[int] = None,
    fabrics: Union[str, Sequence[str], None] = None,
    starts: Optional[int] = None,
    fabric: Optional[Path] = None,
    warp: Optional[Path] = None,
    membrane: Optional[Literal["paper", "uniform", "inverse", "van-gelder", "triangles", "tension", "patches"]] = None,
    bending_law: Optional[Literal["cross", "hinge", "cosine", "plate"]] = None,
    stretch: Optional[float] = None,
    rigidity: Optional[float] = None,
    tension: Optional[float] = None,
    stiffness: Optional[float] = None,
    friction: Optional[float] = None,
    cloth_friction: Optional[float] = None,
    gap: Optional[float] = None,
    gravity: Union[float, Sequence[float], None] = None,
    threads: Optional[int] = None,
    allow_crossings: Optional[int] = None,
    body: Optional[Garment] = None,
    body_unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    cache: Optional[Path] = None,
    pin_box: Union[Sequence[float], Sequence[Sequence[float]], None] = None,
    pin_loop: Union[str, int, Sequence[Union[str, int]], None] = None,
    pin_group: Union[str, Sequence[str], None] = None,
    pin_vertices: Union[int, Sequence[int], None] = None,
    settings: Optional[Mapping[str, Any]] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
def keep(
    garment: Optional[Scene] = None,
    *,
    state: Optional[Path] = None,
    gust: Optional[float] = None,
    kept: Union[float, str, None] = None,
    whole: Optional[bool] = None,
    budget: Optional[float] = None,
    run: Optional[float] = None,
    no_balance: Optional[bool] = None,
    no_settle: Optional[bool] = None,
    no_help: Optional[bool] = None,
    output: Optional[Path] = None,
    save_state: Optional[Path] = None,
    checkpoint: Optional[float] = None,
    inserted: Optional[Path] = None,
    smoothed: Optional[Path] = None,
    animation: Optional[Path] = None,
    save_body: Optional[Path] = None,
    fps: Optional[float] = None,
    seconds: Optional[float] = None,
    stop_at: Optional[float] = None,
    density: Optional[float] = None,
    fabric: Optional[Path] = None,
    warp: Optional[Path] = None,
    membrane: Optional[Literal["paper", "uniform", "inverse", "van-gelder", "triangles", "tension", "patches"]] = None,
    bending_law: Optional[Literal["cross", "hinge", "cosine", "plate"]] = None,
    stretch: Optional[float] = None,
    rigidity: Optional[float] = None,
    tension: Optional[float] = None,
    stiffness: Optional[float] = None,
    bending: Optional[float] = None,
    damping: Optional[float] = None,
    drag: Optional[float] = None,
    friction: Optional[float] = None,
    gap: Optional[float] = None,
    gravity: Union[float, Sequence[float], None] = None,
    wind: Optional[Sequence[float]] = None,
    dt: Optional[float] = None,
    force_dt: Optional[bool] = None,
    integrator: Optional[Literal["auto", "leapfrog", "rk4", "xpbd", "implicit", "tr-bdf2"]] = None,
    sweeps: Optional[int] = None,
    threads: Optional[int] = None,
    subdivide: Optional[int] = None,
    rest: Optional[Literal["stored", "keep"]] = None,
    body: Optional[Garment] = None,
    body_unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    body_frames: Optional[Path] = None,
    body_fps: Optional[float] = None,
    cache: Optional[Path] = None,
    tolerance: Optional[float] = None,
    gradient: Optional[Literal["exact", "interpolated"]] = None,
    pin_box: Union[Sequence[float], Sequence[Sequence[float]], None] = None,
    pin_loop: Union[str, int, Sequence[Union[str, int]], None] = None,
    pin_group: Union[str, Sequence[str], None] = None,
    pin_vertices: Union[int, Sequence[int], None] = None,
    settings: Optional[Mapping[str, Any]] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
def chart(
    scene: Scene,
    *,
    output: Optional[Path] = None,
    csv: Optional[Path] = None,
    accuracy: Union[float, str, None] = None,
    budget: Optional[float] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
    settings: Optional[Mapping[str, Any]] = None,
) -> Result: ...
def fit(
    worn: Union[Garment, Sequence[Garment]],
    *,
    body: Union[Garment, Sequence[Garment], None] = None,
    body_unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    rest_shape: Optional[Garment] = None,
    output: Optional[Path] = None,
    colour: Optional[Literal["strain", "distance"]] = None,
    range: Optional[float] = None,
    tight: Optional[float] = None,
    loose: Optional[float] = None,
    contact: Optional[float] = None,
    smallest_zone: Optional[float] = None,
    section: Optional[Mapping[str, float]] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
def transfer(
    original: Garment,
    wrinkled: Garment,
    *,
    output: Optional[Path] = None,
    rest_shape: Optional[Garment] = None,
    body: Optional[Garment] = None,
    max_distance: Optional[float] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
def follow(
    garment: Garment,
    *,
    body: Optional[Garment] = None,
    body_keys: Union[Garment, Sequence[Garment], None] = None,
    keys: Union[str, Sequence[str], None] = None,
    output: Optional[Path] = None,
    gap: Optional[float] = None,
    poke: Optional[float] = None,
    mixes: Optional[int] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
def bake(
    low: Garment,
    high: Garment,
    *,
    output: Optional[Path] = None,
    texels: Optional[int] = None,
    padding: Optional[int] = None,
    check: Optional[int] = None,
    applied: Optional[Path] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
def subdivide(
    mesh: Garment,
    *,
    output: Optional[Path] = None,
    strokes: Optional[Strokes] = None,
    all: Optional[bool] = None,
    subdivide: Optional[int] = None,
    sqrt3: Optional[int] = None,
    linear: Optional[int] = None,
    max_weights: Optional[int] = None,
    rule: Optional[Literal["safe", "paper"]] = None,
    max_distance: Optional[float] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
def smooth(
    mesh: Garment,
    *,
    output: Optional[Path] = None,
    iterations: Optional[int] = None,
    lambda_: Optional[float] = None,
    mu: Optional[float] = None,
    weights: Optional[Literal["uniform", "cotangent"]] = None,
    keep_lines: Optional[bool] = None,
    keep_border: Optional[bool] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
def body(
    mesh: Garment,
    *,
    output: Optional[Path] = None,
    height: Optional[float] = None,
    chest: Optional[float] = None,
    waist: Optional[float] = None,
    hip: Optional[float] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
def doctor(
    mesh: Garment,
    *,
    body: Optional[Garment] = None,
    body_unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    as_body: Optional[bool] = None,
    repair: Optional[bool] = None,
    output: Optional[Path] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
def quality(
    mesh: Garment,
    *,
    strokes: Optional[Strokes] = None,
    base: Optional[Garment] = None,
    height: Optional[float] = None,
    width: Optional[float] = None,
    max_distance: Optional[float] = None,
    unit: Optional[Literal["m", "cm", "mm", "inch"]] = None,
    up: Optional[Literal["y", "z"]] = None,
    force: Optional[bool] = None,
    replace: Optional[bool] = None,
    progress: Optional[Progress] = None,
    cancel: Optional[Cancel] = None,
) -> Result: ...
