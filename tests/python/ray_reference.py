"""Transmittance by brute force: every ray against every segment and triangle, in float64.

It shares no code with the engine: docs/accuracy.md ("Truth by rays") is all that both follow. In
world space, with distances between lines instead of a frame of the light. Beside T it tells how far
each ray is from a decision, so that rays which rounding decides can be left out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

import pyopacity as po

Array = npt.NDArray[np.float64]


@dataclass
class Rays:
    """Rays from ``points`` toward a light, and what was found along them so far."""

    points: Array
    toward: Array
    bias: float
    optical_depth: Array
    blocked: npt.NDArray[np.bool_]
    margin: Array  # to the nearest decision, in world units or as a fraction of an edge

    def across(self, vectors: Array) -> Array:
        """The part of vectors across the light."""
        return vectors - (vectors @ self.toward)[..., None] * self.toward

    def decide(self, ray: int, *amounts: float | Array) -> None:
        """Notes how far these are from 0, where something else would be decided."""
        least = min(np.abs(amount).min() for amount in amounts)
        self.margin[ray] = min(self.margin[ray], least)


def transmittance(scene: po.Scene, points: Array, bias: float) -> tuple[Array, Array]:
    """(T, margin) at each point."""
    direction = np.array(scene.lights[0].direction, np.float64)
    n = len(points)
    toward = -direction / np.linalg.norm(direction)
    rays = Rays(points, toward, bias, np.zeros(n), np.zeros(n, bool), np.full(n, np.inf))
    for shape in scene.shapes:
        if not shape.casts:
            continue
        matrix = shape.transform
        world = shape.points.astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
        opacity = np.broadcast_to(np.asarray(shape.opacity, np.float64), len(world))
        if isinstance(shape, po.Strands):
            scale = abs(np.linalg.det(matrix[:3, :3])) ** (1.0 / 3.0)
            width = np.broadcast_to(np.asarray(shape.width, np.float64), len(world)) * scale
            for first, end in zip(shape.offsets[:-1], shape.offsets[1:], strict=True):
                strand = slice(first, end)
                for ray in range(n):
                    _strand(rays, ray, world[strand], width[strand] / 2.0, opacity[strand])
        else:
            for triangle in shape.triangles:
                _triangle(rays, world[triangle], opacity[triangle], shape.opaque)
    return np.where(rays.blocked, 0.0, np.exp(-rays.optical_depth)), rays.margin


def _depth(opacity: Array | float) -> Array | float:
    return -np.log1p(-np.minimum(opacity, 1.0 - 2.0**-24))


def _triangle(rays: Rays, corners: Array, opacity: Array, opaque: bool) -> None:
    """Weights of the corners and the distance, from one linear system."""
    a, b, c = corners
    system = np.stack([b - a, c - a, -rays.toward], axis=1)
    if abs(np.linalg.det(system)) < 1e-12:
        return
    v, w, distance = np.linalg.solve(system, (rays.points - a).T)
    weights = np.stack([1.0 - v - w, v, w])
    for ray in range(len(distance)):
        rays.decide(ray, weights[:, ray].min(), distance[ray] - rays.bias)
    hit = (weights > 0.0).all(axis=0) & (distance > rays.bias)
    if opaque:
        rays.blocked |= hit
    else:
        rays.optical_depth[hit] += _depth(opacity @ weights)[hit]


def _strand(rays: Rays, ray: int, points: Array, half: Array, opacity: Array) -> None:
    """Runs of segments that are joined within half a width; each counts at its nearest place."""
    moves = np.append(True, (np.diff(points, axis=0) != 0.0).any(axis=1))  # not a point twice
    points, half, opacity = points[moves], half[moves], opacity[moves]
    to_points = points - rays.points[ray]
    across, distance = rays.across(to_points), to_points @ rays.toward
    axis = np.diff(across, axis=0)
    foot = -(across[:-1] * axis).sum(axis=1) / (axis**2).sum(axis=1)
    t = np.clip(foot, 0.0, 1.0)
    apart = np.linalg.norm(across[:-1] + t[:, None] * axis, axis=1)
    reach = half[:-1] + t * np.diff(half)
    joint = np.linalg.norm(across, axis=1) - half
    inside, joined = apart <= reach, joint <= 0.0
    if not inside.any():
        rays.decide(ray, apart - reach)
        return
    rays.decide(ray, apart - reach, joint, foot, foot - 1.0)
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
            rays.decide(ray, at - rays.bias)
            if at > rays.bias:
                o = opacity[segment] + along * (opacity[segment + 1] - opacity[segment])
                rays.optical_depth[ray] += _depth(float(o))
        if not goes_on:
            places = []
