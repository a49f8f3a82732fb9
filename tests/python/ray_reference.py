"""Transmittance by brute force: every ray against every primitive, in float64.

It shares no code with the engine: docs/accuracy.md ("Truth by rays") is all that both follow. In
world space, with distances between lines instead of a frame of the ray. Beside T it tells how far
each ray is from a decision, so that rays which rounding decides can be left out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

import pyopacity as po
from pyopacity.shapes import PointShape

Array = npt.NDArray[np.float64]


@dataclass
class Ray:
    """One ray toward one point of a light, and what was found along it so far."""

    start: Array
    toward: Array
    bias: float
    length: float
    optical_depth: float = 0.0
    blocked: bool = False
    margin: float = np.inf  # to the nearest decision, in world units or as a fraction of an edge

    def across(self, vectors: Array) -> Array:
        """The part of vectors across the ray."""
        return vectors - (vectors @ self.toward)[..., None] * self.toward

    def decide(self, *amounts: float | Array) -> None:
        """Notes how far these are from 0, where something else would be decided."""
        self.margin = min(self.margin, *(float(np.abs(amount).min()) for amount in amounts))

    def meet(self, distance: float, opacity: float) -> None:
        """Something without extent along the ray."""
        self.decide(distance - self.bias)
        if np.isfinite(self.length):
            self.decide(distance - self.length)
        if self.bias < distance < self.length:
            self.optical_depth += float(_depth(opacity))

    def pass_through(self, near: Array, far: Array, depth_per_length: Array) -> None:
        """Intervals of the ray, or their parts that are before the light and after the bias."""
        length = np.minimum(far, self.length) - np.maximum(near, self.bias)
        self.optical_depth += float((depth_per_length * np.maximum(length, 0.0)).sum())


def transmittance(
    scene: po.Scene, points: Array, bias: float, light: int = 0
) -> tuple[Array, Array]:
    """(T, margin) at each point."""
    T, margin = np.zeros(len(points)), np.full(len(points), np.inf)
    for i, point in enumerate(points):
        rays = _rays_to(scene.lights[light], point, bias)
        for ray in rays:
            for shape in scene.shapes:
                if shape.casts:
                    _cross(ray, shape)
            T[i] += (0.0 if ray.blocked else np.exp(-ray.optical_depth)) / len(rays)
            margin[i] = min(margin[i], ray.margin)
    return T, margin


def _rays_to(light: po.Light, point: Array, bias: float) -> list[Ray]:
    if isinstance(light, po.DirectionalLight):
        direction = np.array(light.direction, np.float64)
        return [Ray(point, -direction / np.linalg.norm(direction), bias, np.inf)]
    middle = np.array(light.position)  # type: ignore[attr-defined]
    ends = [middle]
    if isinstance(light, po.AreaLight):
        steps = (2.0 * np.arange(light.samples) + 1.0 - light.samples) / (2.0 * light.samples)
        u, v = np.array(light.edge_u), np.array(light.edge_v)
        ends = [middle + a * u + b * v for a in steps for b in steps]
    ways = [end - point for end in ends]
    lengths = [float(np.linalg.norm(way)) for way in ways]
    return [Ray(point, way / d, bias, d) for way, d in zip(ways, lengths, strict=True)]


def _cross(ray: Ray, shape: po.Shape) -> None:
    matrix = shape.transform
    scale = abs(np.linalg.det(matrix[:3, :3])) ** (1.0 / 3.0)
    if isinstance(shape, po.Volume):
        _volume(ray, shape)
        return
    assert isinstance(shape, PointShape)
    world = shape.points.astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
    opacity = np.broadcast_to(np.asarray(shape.opacity, np.float64), len(world))
    if isinstance(shape, po.Particles):
        radius = np.broadcast_to(np.asarray(shape.radius, np.float64), len(world)) * scale
        if shape.profile == "metaball":
            _metaballs(ray, world, radius, opacity)
        else:
            _spheres(ray, world, radius, opacity)
    elif isinstance(shape, po.Strands):
        half = np.broadcast_to(np.asarray(shape.width, np.float64), len(world)) * scale / 2.0
        for first, end in zip(shape.offsets[:-1], shape.offsets[1:], strict=True):
            strand = slice(first, end)
            _strand(ray, world[strand], half[strand], opacity[strand])
    elif isinstance(shape, po.Mesh):
        for triangle in shape.triangles:
            _triangle(ray, world[triangle], opacity[triangle], shape, triangle)


def _depth(opacity: Array | float) -> Array:
    return np.asarray(-np.log1p(-np.minimum(opacity, 1.0 - 2.0**-24)))


def _spheres(ray: Ray, centers: Array, radius: Array, opacity: Array) -> None:
    near, far = _inside(ray, centers, radius)
    ray.pass_through(near, far, _depth(opacity) / (2.0 * radius))


def _metaballs(ray: Ray, centers: Array, radius: Array, opacity: Array) -> None:
    """The mean density over what counts of a chord, which three points of Gauss's tell exactly."""
    near, far = _inside(ray, centers, radius)
    near = np.maximum(near, ray.bias)
    far = np.maximum(np.minimum(far, ray.length), near)
    nodes, weights = np.polynomial.legendre.leggauss(3)
    t = 0.5 * (near + far) + 0.5 * (far - near) * nodes[:, None]
    apart = ray.start + t[..., None] * ray.toward - centers
    density = (1.0 - (apart**2).sum(axis=-1) / radius**2) ** 2
    mean = 0.5 * (weights[:, None] * density).sum(axis=0)
    ray.pass_through(near, far, _depth(opacity) * mean * 15.0 / (16.0 * radius))


def _inside(ray: Ray, centers: Array, radius: Array) -> tuple[Array, Array]:
    """Where the quadratic equation of a ray and a sphere has two solutions."""
    apart = ray.start - centers
    b = apart @ ray.toward
    discriminant = b * b - ((apart**2).sum(axis=1) - radius**2)
    ray.decide(discriminant)
    root = np.sqrt(np.maximum(discriminant, 0.0))
    return -b - root, -b + root


def _volume(ray: Ray, volume: po.Volume) -> None:
    """Between all planes that any voxel has, sorted along the ray."""
    local = np.linalg.inv(volume.transform)
    start = local[:3, :3] @ ray.start + local[:3, 3]
    direction = local[:3, :3] @ ray.toward
    extinction = volume.extinction.astype(np.float64)
    size = np.array(extinction.shape[::-1])
    spacing, origin = np.array(volume.spacing), np.array(volume.origin)
    planes = [origin[i] + (np.arange(size[i] + 1) - 0.5) * spacing[i] for i in range(3)]
    cuts = np.sort(np.concatenate([(planes[i] - start[i]) / direction[i] for i in range(3)]))
    near, far = cuts[:-1], cuts[1:]
    middle = start + 0.5 * (near + far)[:, None] * direction
    voxel = np.floor((middle - origin) / spacing + 0.5).astype(int)
    inside = ((voxel >= 0) & (voxel < size)).all(axis=1)
    x, y, z = voxel[inside].T
    speed = float(np.linalg.norm(direction))
    ray.pass_through(near[inside], far[inside], extinction[z, y, x] * speed)


def _triangle(
    ray: Ray, corners: Array, opacity: Array, mesh: po.Mesh, triangle: npt.NDArray[np.uint32]
) -> None:
    """Weights of the corners and the distance, from one linear system."""
    a, b, c = corners
    system = np.stack([b - a, c - a, -ray.toward], axis=1)
    if abs(np.linalg.det(system)) < 1e-12:
        return
    v, w, distance = np.linalg.solve(system, ray.start - a)
    weights = np.array([1.0 - v - w, v, w])
    ray.decide(weights.min())
    if weights.min() <= 0.0:
        return
    if mesh.opaque:
        ray.decide(distance - ray.bias)
        ray.blocked |= ray.bias < distance < ray.length
        return
    o = float(opacity @ weights)
    if mesh.alpha_map is not None and mesh.alpha_mode != "opaque":
        assert mesh.uvs is not None
        o *= _coverage(mesh, weights @ mesh.uvs[triangle].astype(np.float64))
    ray.meet(float(distance), o)


def _coverage(mesh: po.Mesh, uv: Array) -> float:
    """The sum over all texels of a tent that is as wide as two, in a map that repeats."""
    assert mesh.alpha_map is not None
    alpha = mesh.alpha_map.astype(np.float64)
    if mesh.alpha_mode == "mask":
        alpha = (mesh.alpha_map >= np.float32(mesh.alpha_cutoff)).astype(np.float64)
    height, width = alpha.shape

    def tent(at: float, count: int) -> Array:
        total = np.zeros(count)
        for turn in (-1, 0, 1):
            middles = np.arange(count) + 0.5 + turn * count
            total += np.maximum(0.0, 1.0 - np.abs(at % 1.0 * count - middles))
        return total

    return float(tent(uv[1], height) @ alpha @ tent(uv[0], width))


def _strand(ray: Ray, points: Array, half: Array, opacity: Array) -> None:
    """Runs of segments that are joined within half a width; each counts at its nearest place."""
    moves = np.append(True, (np.diff(points, axis=0) != 0.0).any(axis=1))  # not a point twice
    points, half, opacity = points[moves], half[moves], opacity[moves]
    to_points = points - ray.start
    across, distance = ray.across(to_points), to_points @ ray.toward
    axis = np.diff(across, axis=0)
    foot = -(across[:-1] * axis).sum(axis=1) / (axis**2).sum(axis=1)
    t = np.clip(foot, 0.0, 1.0)
    apart = np.linalg.norm(across[:-1] + t[:, None] * axis, axis=1)
    reach = half[:-1] + t * np.diff(half)
    joint = np.linalg.norm(across, axis=1) - half
    inside, joined = apart <= reach, joint <= 0.0
    if not inside.any():
        ray.decide(apart - reach)
        return
    ray.decide(apart - reach, joint, foot, foot - 1.0)
    places: list[tuple[float, int, float]] = []  # of one run: (distance to the ray, segment, t)
    for i in range(len(axis)):
        if inside[i] and 0.0 < foot[i] < 1.0:
            places.append((apart[i], i, t[i]))
        goes_on = i + 1 < len(axis) and inside[i] and inside[i + 1] and joined[i + 1]
        if goes_on and foot[i] >= 1.0 and foot[i + 1] <= 0.0:
            places.append((float(np.linalg.norm(across[i + 1])), i, 1.0))
        if not goes_on and places:
            _, segment, along = min(places)
            at = distance[segment] + along * (distance[segment + 1] - distance[segment])
            o = opacity[segment] + along * (opacity[segment + 1] - opacity[segment])
            ray.meet(float(at), float(o))
        if not goes_on:
            places = []
