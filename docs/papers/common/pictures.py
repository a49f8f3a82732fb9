"""Sheets of labelled pictures, as small PNG files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw, ImageFont

Floats = npt.NDArray[np.floating]
LABEL_PX = 18
GAP_PX = 4
PAPER = (255, 255, 255)
INK = (20, 20, 20)
# The false colours of layers: green is the first, black the last, as in the thesis, figure 5.4.
FIRST, LAST = np.array((0.55, 0.95, 0.45)), np.array((0.0, 0.0, 0.0))


def font(size: int = 12) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    """The one that Pillow brings."""
    return ImageFont.load_default(size)


def to_srgb(linear: Floats) -> npt.NDArray[np.uint8]:
    """(H, W, 3 or 4) linear colours, or (H, W) greys, over white as (H, W, 3) bytes."""
    image = np.asarray(linear, np.float64)
    if image.ndim == 2:
        image = np.repeat(image[..., None], 3, axis=2)
    if image.shape[2] == 4:
        image = image[..., :3] + (1.0 - image[..., 3:])
    image = np.clip(image, 0.0, 1.0)
    encoded = np.where(
        image <= 0.0031308, 12.92 * image, 1.055 * np.maximum(image, 1e-9) ** (1 / 2.4) - 0.055
    )
    return np.rint(255.0 * encoded).astype(np.uint8)


def as_shown(values: Floats) -> Image.Image:
    """Numbers from 0, black, to 1, white, in even steps of what is displayed."""
    bytes_ = np.rint(255.0 * np.clip(np.asarray(values, np.float64), 0.0, 1.0)).astype(np.uint8)
    return Image.fromarray(bytes_).convert("RGB")


def picture(linear: Floats) -> Image.Image:
    """Of a rendered one."""
    return Image.fromarray(to_srgb(linear))


def sheet(parts: Sequence[tuple[str, Image.Image]], columns: int) -> Image.Image:
    """Pictures in rows, each with its label below."""
    width = max(image.width for _, image in parts)
    height = max(image.height for _, image in parts) + LABEL_PX
    rows = -(-len(parts) // columns)
    columns = min(columns, len(parts))
    size = (columns * (width + GAP_PX) - GAP_PX, rows * (height + GAP_PX) - GAP_PX)
    whole = Image.new("RGB", size, PAPER)
    draw = ImageDraw.Draw(whole)
    for i, (label, image) in enumerate(parts):
        left, top = (i % columns) * (width + GAP_PX), (i // columns) * (height + GAP_PX)
        whole.paste(image, (left, top))
        draw.text((left + 2, top + height - LABEL_PX + 1), label, INK, font())
    return whole


def framed(image: Image.Image, box: tuple[int, int, int, int], color: str) -> Image.Image:
    """With a box (left, top, right, bottom) drawn on it."""
    copy = image.copy()
    ImageDraw.Draw(copy).rectangle(box, outline=color, width=4)
    return copy


def layer_colors(part: Floats, layers: int) -> Floats:
    """Linear RGB of where a point lies among its layers, 0 .. 1, in as many steps."""
    step = np.clip(np.floor(np.asarray(part, np.float64) * layers), 0, layers - 1)
    step = step[..., None] / max(layers - 1, 1)
    return FIRST + step * (LAST - FIRST)


def save(path: Path, image: Image.Image) -> None:
    """With a palette of 256 colours."""
    colors = image.convert("RGB")
    palette = colors.quantize(256, method=Image.Quantize.MEDIANCUT)
    colors.quantize(256, palette=palette, dither=Image.Dither.NONE).save(path, optimize=True)
