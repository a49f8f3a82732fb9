"""Files of every format, written by hand, and real ones where this machine has them."""

import json
import logging
import os
import pathlib
import struct
import zlib
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po
from pyopacity.cli import main

DATA = pathlib.Path(
    os.environ.get("PYOPACITY_DATA", pathlib.Path(__file__).parents[3] / "shared" / "data")
)


def png(texels: npt.NDArray[np.uint8]) -> bytes:
    """(H, W, 4) as a picture."""

    def chunk(name: bytes, body: bytes) -> bytes:
        return (
            struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
        )

    height, width, _ = texels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in texels)
    head = struct.pack(">2I5B", width, height, 8, 6, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", head)
        + chunk(b"IDAT", zlib.compress(rows))
        + chunk(b"IEND", b"")
    )


LEAF = np.array([[[0, 255, 0, 255], [0, 188, 0, 0]]], np.uint8)
TRIANGLE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4")

OBJ = b"mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"
PLY = (
    b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    b"property float z\nend_header\n" + TRIANGLE.tobytes()
)
NRRD = b"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 2 1\nspacings: .5 .5 2\nencoding: "


def glb(material: dict[str, Any] | None = None, **document: Any) -> bytes:
    """One triangle, with LEAF as its picture."""
    picture = png(LEAF)
    binary = TRIANGLE.tobytes() + np.eye(3, 2, -1, "<f4").tobytes() + picture
    size = len(TRIANGLE.tobytes())
    views = [(0, size), (size, 24), (size + 24, len(picture))]
    document = {
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0, "translation": [0, 0, 5]}],
        "meshes": [
            {"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}
        ],
        "materials": [
            {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}} | (material or {})
        ],
        "textures": [{"source": 0}],
        "images": [{"bufferView": 2, "mimeType": "image/png"}],
        "accessors": [
            {"bufferView": view, "componentType": 5126, "count": 3, "type": kind}
            for view, kind in enumerate(["VEC3", "VEC2"])
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": begin, "byteLength": length} for begin, length in views
        ],
        "buffers": [{"byteLength": len(binary)}],
    } | document
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4s2I", b"glTF", 2, 12 + len(chunks)) + chunks


Load = Callable[..., list[po.Shape]]


@pytest.fixture(name="load")
def loader(tmp_path: pathlib.Path) -> Load:
    """Loads bytes as a file of a name."""

    def load(name: str, content: bytes, **beside: bytes) -> list[po.Shape]:
        for other, bytes_ in beside.items():
            (tmp_path / other.replace("_", ".")).write_bytes(bytes_)
        path = tmp_path / name
        path.write_bytes(content)
        return po.load(path)

    return load


def test_an_objs_cut_out(load: Load) -> None:
    (leaf,) = load("m.obj", OBJ, m_mtl=b"newmtl a\nmap_Kd a.png\n", a_png=png(LEAF))
    assert isinstance(leaf, po.Mesh) and leaf.alpha_mode == "mask" and leaf.alpha_cutoff == 0.5
    assert leaf.alpha_map is not None and leaf.alpha_map.tolist() == [[1, 0]]
    assert leaf.color_map is not None and leaf.color_map[0, :, 1] == pytest.approx([1, 0.503], 1e-3)
    assert leaf.uvs is not None and leaf.uvs.tolist() == [[0, 1], [1, 1], [0, 0]]
    assert not leaf.opaque


def test_a_glbs_mask_and_transform(load: Load) -> None:
    (leaf,) = load("m.glb", glb({"alphaMode": "MASK", "alphaCutoff": 0.25}))
    assert isinstance(leaf, po.Mesh) and leaf.alpha_mode == "mask" and leaf.alpha_cutoff == 0.25
    assert leaf.transform[2, 3] == 5.0
    assert leaf.uvs is not None and leaf.uvs.tolist() == [[0, 0], [1, 0], [0, 1]]


def test_a_plys_points(load: Load) -> None:
    (cloud,) = load("m.ply", PLY)
    assert isinstance(cloud, po.Particles) and cloud.radius == 0.5
    assert np.array_equal(cloud.points, TRIANGLE)


@pytest.mark.parametrize("encoding", ["raw", "gzip"])
def test_an_nrrds_voxels(load: Load, encoding: str) -> None:
    voxels = bytes(range(6))
    pack = zlib.compressobj(wbits=31)  # with gzip's header
    body = voxels if encoding == "raw" else pack.compress(voxels) + pack.flush()
    (smoke,) = load("m.nrrd", NRRD + encoding.encode() + b"\n\n" + body)
    assert isinstance(smoke, po.Volume)
    assert smoke.extinction.tolist() == [[[0, 1, 2], [3, 4, 5]]]
    assert smoke.spacing == (0.5, 0.5, 2.0)


def test_what_is_missing_is_logged(load: Load, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING, "pyopacity"):
        (leaf,) = load("m.obj", OBJ, m_mtl=b"newmtl a\nKd 1 0 0\nmap_Kd lost.png\n")
    assert leaf.color == pytest.approx((0.7, 0.7, 0.7))
    assert "lost.png" in caplog.text and "m.obj" in caplog.text


@pytest.mark.parametrize(
    ("name", "content"),
    [("m.glb", glb()), ("m.ply", PLY), ("m.nrrd", NRRD + b"raw\n\n" + bytes(6))],
)
def test_a_cut_anywhere_is_an_error(load: Load, name: str, content: bytes) -> None:
    load(name, content)
    for size in range(0, len(content), 11):
        with pytest.raises(po.FileFormatError, match=name):
            load(name, content[:size])


def test_the_extension_that_is_not_read_is_named(load: Load) -> None:
    with pytest.raises(po.FileFormatError, match="KHR_draco_mesh_compression"):
        load("m.glb", glb(extensionsRequired=["KHR_draco_mesh_compression"]))


def test_info_tells_of_every_kind(
    load: Load, tmp_path: pathlib.Path, capsys: pytest.CaptureFixture[str]
) -> None:
    load("m.glb", glb({"alphaMode": "MASK"}))
    load("m.ply", PLY)
    load("m.nrrd", NRRD + b"raw\n\n" + bytes(range(6)))
    files = [str(tmp_path / name) for name in ("m.glb", "m.ply", "m.nrrd")]
    assert main(["info", *files]) == 0
    told = capsys.readouterr().out
    for words in ("mask at 0.5, 2 x 1 texels", "particles: 3 points", "3 x 2 x 1 voxels"):
        assert words in told
    assert main(["info", *files, "--json"]) == 0
    leaf, cloud, smoke = (d["shapes"][0] for d in json.loads(capsys.readouterr().out))
    assert leaf["alpha_map"] == leaf["color_map"] == [2, 1]
    assert cloud["radius"] == [0.5, 0.5]
    assert smoke["voxels"] == [3, 2, 1] and smoke["extinction"] == [0.0, 5.0]


# ---- real models ----


def opaque_part(mesh: po.Mesh) -> tuple[float, float]:
    """The area of a cut-out's triangles, and how much of it is covered."""
    assert mesh.uvs is not None and mesh.alpha_map is not None
    corners, places = mesh.points[mesh.triangles], mesh.uvs[mesh.triangles]
    sides = corners[:, 1:] - corners[:, :1]
    area = 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    height, width = mesh.alpha_map.shape
    steps, covered = 16, np.zeros(len(area))
    weights = [
        (i + c, k + c) for i in range(steps) for k in range(steps - i) for c in (1 / 3, 2 / 3)
    ]
    weights = [(a, b) for a, b in weights if a + b < steps]
    for a, b in np.array(weights) / steps:
        u, v = ((1 - a - b) * places[:, 0] + a * places[:, 1] + b * places[:, 2]).T
        columns, rows = (u % 1 * width).astype(int), (v % 1 * height).astype(int)
        texels = mesh.alpha_map[np.minimum(rows, height - 1), np.minimum(columns, width - 1)]
        covered += texels >= mesh.alpha_cutoff
    return float(area.sum()), float((area * covered).sum() / len(weights))


@pytest.mark.parametrize(
    ("name", "part"),
    [
        ("sanmiguel_tree_a_leaves.glb", 0.55),
        ("eztree_oak_large.obj", 0.26),
        ("cs_terrainf_tree.obj", 0.53),
        ("urtica_dioica_1.obj", 0.61),
    ],
)
def test_real_leaves_lie_where_their_picture_shows_them(name: str, part: float) -> None:
    path = DATA / "foliage" / name
    if not path.exists():
        pytest.skip(f"{path}: not there; set PYOPACITY_DATA")
    meshes = [mesh for mesh in po.load(path) if isinstance(mesh, po.Mesh)]
    parts = [opaque_part(mesh) for mesh in meshes if mesh.alpha_map is not None]
    assert parts
    area, covered = np.sum(parts, axis=0)
    assert covered / area == pytest.approx(part, abs=0.01)
