"""What casts shadows and receives them: strands, meshes, particles and volumes."""

from pyopacity import _native
from pyopacity.shapes.mesh import Mesh
from pyopacity.shapes.particles import Particles
from pyopacity.shapes.shape import PointShape, Shape
from pyopacity.shapes.strands import Strands
from pyopacity.shapes.volume import Volume

__all__ = ["Mesh", "Particles", "PointShape", "Shape", "Strands", "Volume", "wrap"]

_CLASSES: dict[type[_native.Shape], type[Shape]] = {
    _native.Strands: Strands,
    _native.Mesh: Mesh,
    _native.Particles: Particles,
    _native.Volume: Volume,
}


def wrap(native: _native.Shape) -> Shape:
    """The public class around a shape that the engine made."""
    cls = _CLASSES[type(native)]
    shape = cls.__new__(cls)
    Shape.__init__(shape, native)
    return shape
