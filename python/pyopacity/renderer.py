"""Pictures of a scene, and how much light reaches a point of it."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from types import TracebackType
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays, _log, _native
from pyopacity._arrays import Floats, Vector
from pyopacity._attributes import HasParameters, add_parameters
from pyopacity.camera import Camera
from pyopacity.errors import ContextError, OutOfMemoryError
from pyopacity.pass_report import PassReport, Report, ResourceMemory
from pyopacity.picture_receivers import PictureReceivers
from pyopacity.scene import Scene
from pyopacity.shapes import Shape
from pyopacity.technique import Technique
from pyopacity.technique import technique as make_technique


class Renderer(HasParameters):
    """Renders a scene, and skips whatever has not changed since the last frame.

    It makes its own OpenGL context, without a window, and belongs to the thread that made it. What
    OpenGL has to say goes to the logger "pyopacity". Close it, or use it in a ``with`` statement.

    Args:
        scene: stays alive as long as the renderer, and may change at any time.
        camera: the default sees all of the scene, see :meth:`pyopacity.Camera.fit`.
        size: width and height of the picture in pixels; the default is 1024 x 768.
        technique: a name, or what :func:`pyopacity.technique` makes.
        background: linear RGB or RGBA behind everything; alpha 0 for a transparent picture.
        device: "gpu", which is whatever OpenGL there is, also one in software; or "cpu", which
            needs none: the same maps in C++ on all cores, for :meth:`transmittance` of techniques
            that have them there, and no pictures.
        settings: the parameters below.

    Raises:
        ContextError: no OpenGL; it lists what was tried and what to install.
        ParameterError: a value outside its range, a name that does not exist.
    """

    __slots__ = ("_camera", "_context", "_handle", "_scene", "_technique")
    _handle: _native.Renderer | None
    _context: _native.Context | None
    _scene: Scene
    _camera: Camera
    _technique: Technique

    # What **settings may hold.
    _more_keywords = tuple(setting.name for setting in _native.RenderSettings().parameters())

    def __init__(
        self,
        scene: Scene,
        camera: Camera | None = None,
        size: tuple[int, int] | None = None,
        technique: str | Technique = "bounding_opacity_maps",
        background: Vector | None = None,
        device: Literal["gpu", "cpu"] = "gpu",
        **settings: Any,
    ) -> None:
        self._handle = None
        if not isinstance(scene, Scene):
            raise _arrays.wrong("scene", scene, "a pyopacity.Scene: Scene(shapes, light)")
        _arrays.choice("device", device, ("gpu", "cpu"))
        self._scene = scene
        self._camera = _camera(Camera.fit(scene) if camera is None else camera)
        self._technique = _technique(technique)
        self._context = _native.Context.headless() if device == "gpu" else None
        try:
            self._handle = _native.Renderer(
                scene._handle, self._camera._handle, self._technique._handle, self._context
            )
            if size is not None:
                self.size = size
            if background is not None:
                self.background = background
            for name, value in settings.items():
                self._handle.settings().set(name, _arrays.parameter(name, value))
        except BaseException:
            self.close()
            raise

    # ---- pictures and light ----

    def render(self, out: npt.NDArray[np.float32] | None = None) -> npt.NDArray[np.float32]:
        """The picture: (H, W, 4) float32, linear, premultiplied by alpha, top row first.

        Args:
            out: an array of that kind to fill, instead of a new one.

        Raises:
            ParameterError: ``out`` has another dtype, shape or order, or cannot be written to.
            ContextError: closed, another thread, a forked process, or ``device="cpu"``.
            OutOfMemoryError: the driver cannot hold the maps or the picture.
        """
        width, height = self.size
        image = (
            self._new_image() if out is None else _arrays.to_fill("out", out, (height, width, 4))
        )
        with self._log_after():
            self._engine.render(image)
        return image

    def transmittance(
        self, where: Floats | Shape, light: int = 0, out: npt.NDArray[np.float32] | None = None
    ) -> npt.NDArray[np.float32]:
        """The part of a light that arrives at points, in [0, 1]; 1 where the scene has no light.

        Casters nearer than the technique's ``bias`` toward the light do not count, so that a strand
        does not shadow itself. ``bias="auto"`` is the width of a shape's strands, for points the
        mean width of the scene's, and at least 1e-4 of the casters' radius. At the points of a
        shape, a technique with ``own_correction`` takes out what the map holds of the shape there.
        Asked the same again, it hands out what was found.

        Args:
            where: world positions, (N, 3) float32 or float64; or a shape: its own points, moved by
                its transform in float64.
            light: index into ``scene.lights``.
            out: an array of the kind that is returned to fill, instead of a new one.

        Returns:
            (N,) float32; (N, 3), red, green and blue, where a shape of the scene has an opacity or
            extinction a colour.

        Raises:
            ParameterError: another dtype, shape or order; a point that is not finite, named by its
                index; a light that is not there; an ``out`` that does not fit.
        """
        index = _arrays.whole("light", light)
        if out is not None:
            is_rgb = self._scene._handle.is_tinted()
            out = _arrays.to_fill("out", out, ("N", 3) if is_rgb else ("N",))
        asked: Floats | _native.Shape
        if isinstance(where, Shape):
            asked = where._handle
        else:
            asked = _arrays.floats("points", where, ("N", 3))
        with self._log_after():
            if out is None:
                return self._engine.transmittance(asked, index)
            self._engine.fill_transmittance(asked, index, out)
            return out

    def image(self, name: str, light: int = 0) -> npt.NDArray[Any]:
        """Another image of what the picture shows, top row first.

        Args:
            name: "coverage", how much of a pixel the shapes cover: the picture's alpha without its
                background. Or, of the first strand or surface in the middle of each pixel:
                "transmittance", the part of a light that arrives there, 1 where there is none;
                "depth", its distance from the camera in world units, infinite where there is none;
                "object_id", its index in ``scene.shapes``, -1 where there is none.
            light: index into ``scene.lights``, for "transmittance".

        Returns:
            (H, W) float32; int32 for "object_id"; (H, W, 3) for "transmittance" where T has a value
            a colour.

        Raises:
            ParameterError: another name; a light that is not there.
            ContextError: as :meth:`render`.
        """
        if not isinstance(name, str):
            raise _arrays.wrong("name", name, "the name of an image")
        with self._log_after():
            values = self._engine.image(name, _arrays.whole("light", light))
        return values.astype(np.int32) if name == "object_id" else values

    def receivers(self) -> PictureReceivers:
        """The points at which the picture looks T up, one a pixel.

        They are those of the picture that :meth:`render` makes with ``antialiasing`` 1. With T
        there from any other source, the picture is *dark + T (lit - dark)*, since shading is linear
        in T: *lit* is rendered by the technique that casts no shadow, *dark* without a light.
        """
        with self._log_after():
            points, bias = self._engine.receivers()
        mask = bias >= 0.0
        bias[~mask] = 0.0
        return PictureReceivers(points, bias, mask)

    def read(self, name: str) -> npt.NDArray[np.float32]:
        """A texture of the last frame by name, such as "bounding_opacity_maps/opacity".

        Returns:
            float32 (H, W) for one channel, (H, W, C), or (layers, H, W, C) for an array; the
            light's first row first.

        Raises:
            ParameterError: there is no such texture; the fix lists those that there are.
        """
        if not isinstance(name, str):
            raise _arrays.wrong("name", name, "the name of a texture")
        with self._log_after():
            return self._engine.read(name)

    # ---- what was done ----

    @property
    def report(self) -> Report:
        """What each pass of the last frame did, and why; a table when printed."""
        rows, table = self._engine.report()
        return Report((PassReport(*row) for row in rows), table)

    def memory(self) -> list[ResourceMemory]:
        """What the last picture or look-up needed of memory: textures and buffers, by name."""
        return [ResourceMemory(*row) for row in self._engine.memory()]

    @property
    def light_from_world(self) -> npt.NDArray[np.float64]:
        """World to the first light's map, as the last frame fitted it, (4, 4) float64 by rows.

        x and y come out in texels, z in 0 .. 1 along the light.
        """
        return self._engine.light_from_world(0)

    def graph_dot(self) -> str:
        """The passes of the last frame and what they read and write, as a Graphviz digraph."""
        return self._engine.graph_dot()

    def invalidate(self) -> None:
        """Forgets every cached pass: the next frame does everything again."""
        self._engine.invalidate()

    def needs_recompute(self) -> None:
        """Has the next frame search the split of the layers again."""
        self._engine.needs_recompute()

    @property
    def context(self) -> _native.Context:
        """The OpenGL context: its ``renderer``, ``version``, ``is_software``, ``live_objects``.

        Raises:
            ContextError: the renderer was made with ``device="cpu"``.
        """
        if self._context is None:
            raise ContextError(
                'a renderer with device="cpu" has no OpenGL context', 'make one with device="gpu"'
            )
        return self._context

    @property
    def device(self) -> str:
        """What it runs on, as OpenGL calls it, or "cpu"."""
        return "cpu" if self._context is None else self._context.renderer

    # ---- settings ----

    @property
    def scene(self) -> Scene:
        """What is rendered. It may change; another scene needs another renderer."""
        return self._scene

    @property
    def camera(self) -> Camera:
        """From where the picture is taken. Shadows do not depend on it."""
        return self._camera

    @camera.setter
    def camera(self, camera: Camera) -> None:
        self._engine.set_camera(_camera(camera)._handle)
        self._camera = camera

    @property
    def technique(self) -> Technique:
        """The shadow method; its parameters are its attributes. Set a name, or a technique."""
        return self._technique

    @technique.setter
    def technique(self, technique: str | Technique) -> None:
        new = _technique(technique)
        self._engine.set_technique(new._handle)
        self._technique = new

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture in pixels."""
        settings = self._engine.settings()
        return int(settings.get("width")), int(settings.get("height"))

    @size.setter
    def size(self, size: tuple[int, int]) -> None:
        if not isinstance(size, tuple | list) or len(size) != 2:
            raise _arrays.wrong("size", size, "(width, height) in pixels")
        width, height = _arrays.whole("size[0]", size[0]), _arrays.whole("size[1]", size[1])
        self._engine.set_size(width, height)

    @property
    def background(self) -> tuple[float, float, float, float]:
        """Linear RGBA behind everything; set RGB for alpha 1."""
        r, g, b, a = (_arrays.shortest(value) for value in self._engine.background())
        return r, g, b, a

    @background.setter
    def background(self, background: Vector) -> None:
        rgba = (*_arrays.numbers("background", background, (3, 4)), 1.0)
        self._engine.set_background(rgba[:4])

    def _owner(self) -> _native.ParamOwner:
        return self._engine.settings()

    # ---- life ----

    def close(self) -> None:
        """Frees what it holds on the GPU; done twice it does nothing. Its pictures stay."""
        self._handle = None

    @property
    def closed(self) -> bool:
        """Whether it was closed."""
        return self._handle is None

    def __enter__(self) -> Renderer:
        return self

    def __exit__(
        self,
        error_type: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        if self.closed:
            return "<Renderer: closed>"
        width, height = self.size
        return f"<Renderer: {width}x{height}, {self._technique.name}, on {self.device}>"

    @property
    def _engine(self) -> _native.Renderer:
        if self._handle is None:
            raise ContextError("the renderer is closed", "make a new one, or close it later")
        return self._handle

    @contextlib.contextmanager
    def _log_after(self) -> Iterator[None]:
        """Passes on what OpenGL said meanwhile, also where the call failed."""
        try:
            yield
        finally:
            _log.pass_on(self._context.take_messages() if self._context else ())

    def _new_image(self) -> npt.NDArray[np.float32]:
        width, height = self.size
        try:
            return np.empty((height, width, 4), np.float32)
        except MemoryError as error:
            raise OutOfMemoryError(
                f"no memory is left for a picture of {width}x{height}", "choose a smaller size"
            ) from error


def _camera(camera: object) -> Camera:
    if not isinstance(camera, Camera):
        raise _arrays.wrong("camera", camera, "pyopacity.Camera.look_at(...) or Camera.fit(scene)")
    return camera


def _technique(technique: object) -> Technique:
    if isinstance(technique, Technique):
        return technique
    if not isinstance(technique, str):
        raise _arrays.wrong("technique", technique, "a name, or pyopacity.technique(name, ...)")
    return make_technique(technique)


# The picture's width and height are set together, as `size`.
add_parameters(
    Renderer,
    (p for p in _native.RenderSettings().parameters() if p.name not in ("width", "height")),
)
