// Light space: x and y in texels of the map, z the linear distance along the light as a fraction of
// the casters' range: 0 at the first caster, 1 behind the last one that any receiver can see.

uniform int u_light_map_size_px;
uniform float u_light_depth_range;      // world units from z = 0 to z = 1
uniform float u_light_texels_per_unit;  // 1 / the side of a texel in world units
