"""What the benchmark measures, and how large."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

from pyopacity.benchmark.clock import Clock

Device = Literal["gpu", "cpu"]


@dataclass(frozen=True, slots=True)
class GoalSizes:
    """Of what the goals are measured on.

    Attributes:
        segments: of demo:hair, each a row of the goals of a frame.
        deposit_segments, look_up_segments: of demo:hair, for the goals of the deposit and of T at
            every vertex.
        call_segments: of demo:hair, where a call from Python is compared with C++.
        call_repeats: of each call; 0 for none, and no programme is built.
        size: of the frame's picture, pixels.
        map_size, layers: of the maps.
        picture_size, picture_samples: of the picture that Mitsuba makes too: pixels, and rays a
            pixel of the timed one and of the one that errors are told against.
    """

    segments: tuple[int, ...] = (150_000, 1_050_000)
    deposit_segments: int = 1_000_000
    look_up_segments: int = 1_000_000
    call_segments: int = 10_000
    call_repeats: int = 300
    size: tuple[int, int] = (1024, 768)
    map_size: int = 512
    layers: int = 16
    picture_size: tuple[int, int] = (256, 192)
    picture_samples: tuple[int, int] = (16, 256)


@dataclass(frozen=True, slots=True)
class Plan:
    """Which scenes, on which maps, and how carefully.

    Attributes:
        device: "gpu", whatever OpenGL there is; or "cpu", without.
        scenes: what :func:`pyopacity.load` takes, each a scene of its own.
        hair: the scene of the goals about errors: strands.
        changes: of every strand, such as its opacity.
        map_sizes: texels along each side.
        large, large_map_sizes: a scene of more primitives has these map sizes alone, or one scene
            would take as long as all others.
        layers: of techniques that have them; Fourier's have one coefficient less.
        judged_px: T is compared over two texels of a map of this size, whatever the map's own is.
        receivers, rays: points at which T is compared, and rays to a footprint.
        scaled_segments, scaled_map_sizes, scaled_layers, scaled_lights: along which costs grow.
        brute_force_segments: of the scene that numpy goes through.
        clock: how things take turns.
        grid_clock: the same where many settings do: time against error, scaling and costs.
        goals: sizes of the goals.
        is_quick: whether scenes are smaller than the goals say.
    """

    device: Device = "gpu"
    scenes: tuple[str, ...] = (
        "demo:hair?segments=15000",
        "demo:hair?segments=150000",
        "demo:tree?leaves=100000",
        "demo:plume?particles=100000",
        "demo:smoke?voxels=1000000",
        "demo:hair?segments=1050000",
        "demo:hair?segments=4000000",
    )
    hair: str = "demo:hair?segments=150000"
    changes: Mapping[str, Any] = field(default_factory=dict)
    map_sizes: tuple[int, ...] = (256, 512, 1024)
    large: int = 1_000_000
    large_map_sizes: tuple[int, ...] = (512,)
    layers: tuple[int, ...] = (4, 16)
    judged_px: int = 512
    receivers: int = 2000
    rays: int = 64
    scaled_segments: tuple[int, ...] = (15_000, 50_000, 150_000, 500_000, 1_500_000)
    scaled_map_sizes: tuple[int, ...] = (256, 512, 1024, 2048)
    scaled_layers: tuple[int, ...] = (4, 8, 16, 32, 64)
    scaled_lights: tuple[int, ...] = (1, 2, 4)
    brute_force_segments: int = 5_000
    clock: Clock = Clock()
    grid_clock: Clock = Clock(least=2, budget_s=30.0)
    goals: GoalSizes = GoalSizes()
    is_quick: bool = False

    def map_sizes_of(self, primitives: int) -> tuple[int, ...]:
        """Of a scene with so many."""
        return self.large_map_sizes if primitives > self.large else self.map_sizes

    def on(self, device: Device) -> Plan:
        """The same on another device."""
        return replace(self, device=device)


FULL = Plan()

# Sized for two minutes on two quiet cores and OpenGL in software.
QUICK = Plan(
    scenes=("demo:hair?segments=5000", "demo:tree?leaves=1500", "demo:plume?particles=1000"),
    hair="demo:hair?segments=5000",
    map_sizes=(64, 128),
    layers=(8,),
    judged_px=128,
    receivers=400,
    rays=16,
    scaled_segments=(2_000, 6_000, 20_000),
    scaled_map_sizes=(64, 128, 256),
    scaled_layers=(4, 16),
    scaled_lights=(1, 2),
    brute_force_segments=1_000,
    clock=Clock(rounds=5, least=3, budget_s=2.0),
    grid_clock=Clock(rounds=5, least=3, budget_s=2.0),
    goals=GoalSizes(
        segments=(15_000,),
        deposit_segments=50_000,
        look_up_segments=15_000,
        call_segments=2_000,
        call_repeats=60,
        size=(320, 240),
        map_size=256,
        picture_size=(64, 48),
        picture_samples=(4, 16),
    ),
    is_quick=True,
)
