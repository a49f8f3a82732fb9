"""Shapes from files."""

import os

from pyopacity import _arrays, _log, _native
from pyopacity.shapes import Shape, wrap

__all__ = ["load"]


def load(path: str | os.PathLike[str]) -> list[Shape]:
    """The shapes in a file, or generated ones.

    - ``.hair`` (cyHair): strands, with what arrays it has for width, opacity and colour.
    - ``.obj`` and its ``.mtl``: a mesh for each material, with its colour (Kd, map_Kd) and opacity
      (d, Tr, map_d). A map_d, or a map_Kd with holes in its alpha channel, makes a mask.
    - ``.gltf``, ``.glb`` (glTF 2.0): the meshes of its nodes, at rest, as instances with a
      transform; base colour and alpha of their materials; points as particles.
    - ``.ply``: a mesh with the normals, colours and opacities that its vertices have; without faces
      particles, whose radius is the file's, or half the mean distance to the next point.
    - ``.nrrd``: a volume of three axes, raw or gzip, with the extinction as the file has it. Set
      ``extinction`` to bring densities to your units.
    - ``demo:NAME``, or with options ``demo:NAME?segments=1000000&seed=7``: a generated scene, the
      same for the same seed on every machine. Its last shape is a ground that does not cast.

      - of strands, with ``segments``: ``hair`` over a head (``style`` is ``wavy``, ``straight`` or
        ``curly``), ``fur`` on a rabbit, ``teapot`` in a coat of fur, ``grass``, ``dense_grass``;
      - of quads with an alpha map, with ``leaves``: ``tree`` and, in autumn, ``sparse_tree``;
      - of a volume, with ``voxels`` at most: ``smoke`` over a fireplace, ``clouds`` over a plain;
      - of ``particles``: ``plume``, the smoke of a chimney;
      - of all but a volume, with ``primitives``: ``mixed``.

    Pictures are PNG or JPEG. Only files in the model's own folder are opened. Where a model lacks
    something without which it still has a shape, such as a picture, that surface is grey and the
    logger "pyopacity.io" has a warning.

    Raises:
        FileFormatError: a file that is missing, truncated, not what its name says, or of a format
            that is not read. Memory never grows far beyond the size of the file and its pictures.
        ParameterError: a demo or an option that does not exist.
    """
    shapes, messages = _native.load(_arrays.path(path))
    _log.pass_on(messages, "pyopacity.io")
    return [wrap(native) for native in shapes]
