"""Shadows through hair and other translucent things, by opacity mapping on OpenGL.

::

    import pyopacity as po

    scene = po.Scene(po.load("straight.hair"), po.DirectionalLight((.5, .3, -.8)))
    with po.Renderer(scene, technique="bounding_opacity_maps") as renderer:
        po.save_image("hair.png", renderer.render())
        print(renderer.report)

Importing needs no OpenGL; only a :class:`Renderer` does.
"""

import logging

from pyopacity import _native, metrics
from pyopacity.bounds import Bounds
from pyopacity.camera import Camera
from pyopacity.described import CasterPass, Choice, Param, TexelPass, Texture, register_technique
from pyopacity.errors import (
    ContextError,
    DeviceLostError,
    Error,
    FileFormatError,
    ForkedContextError,
    OutOfMemoryError,
    ParameterError,
    PluginError,
    ShaderError,
    UnknownNameError,
)
from pyopacity.image import save_image
from pyopacity.io import load
from pyopacity.light import AreaLight, DirectionalLight, Light, PointLight, SpotLight
from pyopacity.look_up import transmittance
from pyopacity.pass_report import PassReport, Report, ResourceMemory
from pyopacity.picture_receivers import PictureReceivers
from pyopacity.reference_picture import traced_picture
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene
from pyopacity.shapes import Mesh, Particles, Shape, Strands, Volume
from pyopacity.technique import (
    Parameter,
    Technique,
    TechniqueInfo,
    load_plugin,
    technique,
    techniques,
)
from pyopacity.trace import trace_backends, trace_transmittance
from pyopacity.tuning import LayerChoice, LayerTrial, tune

__version__ = _native.version()

# A library says nothing on its own: without this, Python prints warnings that nobody listens to.
logging.getLogger("pyopacity").addHandler(logging.NullHandler())

__all__ = [
    "AreaLight",
    "Bounds",
    "Camera",
    "CasterPass",
    "Choice",
    "ContextError",
    "DeviceLostError",
    "DirectionalLight",
    "Error",
    "FileFormatError",
    "ForkedContextError",
    "LayerChoice",
    "LayerTrial",
    "Light",
    "Mesh",
    "OutOfMemoryError",
    "Param",
    "Parameter",
    "ParameterError",
    "Particles",
    "PassReport",
    "PictureReceivers",
    "PluginError",
    "PointLight",
    "Renderer",
    "Report",
    "ResourceMemory",
    "Scene",
    "ShaderError",
    "Shape",
    "SpotLight",
    "Strands",
    "Technique",
    "TechniqueInfo",
    "TexelPass",
    "Texture",
    "UnknownNameError",
    "Volume",
    "load",
    "load_plugin",
    "metrics",
    "register_technique",
    "save_image",
    "technique",
    "techniques",
    "trace_backends",
    "trace_transmittance",
    "traced_picture",
    "transmittance",
    "tune",
]
