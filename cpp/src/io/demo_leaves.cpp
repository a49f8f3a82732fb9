#include "io/demo_leaves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace opacity::demo {
namespace {

constexpr double width_of_length = 0.62;
constexpr int map_width = 64, map_height = 96;

// A place on the leaf's map: half widths to the side of the midrib, and 0 at the foot of the stalk
// to 1 at the tip.
struct OnLeaf {
    double side, along;
};

double part_above(double x) {
    return x - std::floor(x);
}

// An oval with a point and teeth, on a stalk.
double half_width(double along) {
    constexpr double stalk = 0.12;
    if (along < stalk) return 0.035;
    const double s = (along - stalk) / (1.0 - stalk);
    const double teeth = 1.0 - 0.1 * part_above(13.0 * s);
    return std::max(0.035, 2.45 * std::sqrt(s) * (1.0 - s) * teeth);
}

template <class Value>
TextureMapPtr texture(int channels, const Value& value) {
    auto map = std::make_shared<TextureMap>(
        TextureMap{map_width, map_height, channels, std::vector<float>{}});
    for (int y = 0; y < map_height; ++y)
        for (int x = 0; x < map_width; ++x) {
            const OnLeaf place{std::abs(2.0 * (x + 0.5) / map_width - 1.0),
                               1.0 - (y + 0.5) / map_height};
            for (int channel = 0; channel < channels; ++channel)
                map->values.push_back(float(value(place, channel)));
        }
    return map;
}

// Half covered on the outline.
TextureMapPtr outline() {
    return texture(1, [](const OnLeaf& place, int) {
        const double inside = half_width(place.along) - place.side;
        return std::clamp(0.5 + 0.25 * map_width * inside, 0.0, 1.0);
    });
}

// Pale veins, which rise from the midrib to the edge.
TextureMapPtr veins() {
    return texture(3, [](const OnLeaf& place, int channel) {
        const double side_vein = std::abs(part_above(7.0 * (place.along - 0.3 * place.side)) - 0.5);
        const bool pale = place.side < 0.06 || side_vein > 0.44;
        constexpr double tint[] = {1.35, 1.2, 1.3};
        return pale ? tint[channel] : 0.95;
    });
}

// Draws places on the outer parts of shoots, by their length.
class Twigs {
   public:
    explicit Twigs(const std::vector<Shoot>& shoots) : shoots_{shoots} {
        constexpr double leafy[] = {0.0, 0.05, 0.35, 1.0};
        double sum = 0.0;
        for (const Shoot& shoot : shoots)
            length_.push_back(sum += shoot.length * leafy[shoot.level]);
    }
    const Shoot& draw(Random& random) const {
        const double sought = random.uniform() * length_.back();
        const auto found = std::upper_bound(length_.begin(), length_.end() - 1, sought);
        return shoots_[std::size_t(found - length_.begin())];
    }

   private:
    const std::vector<Shoot>& shoots_;
    std::vector<double> length_;  // up to each shoot's end
};

struct LeafArrays {
    Triangles quads;
    std::vector<float2> uvs;
    std::vector<float3> colors;

    void add(const glm::dvec3& foot, const glm::dvec3& along, const glm::dvec3& side,
             const glm::dvec3& color) {
        const std::uint32_t a = quads.add(foot - side), b = quads.add(foot + side),
                            c = quads.add(foot + along + side), d = quads.add(foot + along - side);
        quads.quad(a, b, c, d);
        uvs.insert(uvs.end(), {{0.f, 1.f}, {1.f, 1.f}, {1.f, 0.f}, {0.f, 0.f}});
        colors.insert(colors.end(), 4, {float(color.x), float(color.y), float(color.z)});
    }
};

// Outward from its shoot, its face more or less to the sky.
void add_leaf(LeafArrays& arrays, const Shoot& shoot, const Foliage& foliage, Random& random) {
    const double t = 0.15 + 0.85 * glm::sqrt(random.uniform());
    const glm::dvec3 stem = shoot.tangent(t), away = across(stem, random.unit_vector());
    const glm::dvec3 stray = random.unit_vector();
    const glm::dvec3 along =
        glm::normalize(0.55 * stem + away + 0.3 * stray - glm::dvec3{0.0, 0.0, 0.3});
    const glm::dvec3 face = across(along, glm::dvec3{0.0, 0.0, 1.0} + 0.8 * random.unit_vector());
    const double length = foliage.leaf_length * (1.0 + 0.3 * random.around_zero());
    const double tone = random.uniform() * double(foliage.colors.size() - 1);
    const auto i = std::size_t(tone);
    const glm::dvec3 color =
        foliage.colors[i] + (tone - double(i)) * (foliage.colors[i + 1] - foliage.colors[i]);
    arrays.add(shoot.at(t), length * along,
               0.5 * width_of_length * length * glm::cross(along, face),
               (1.0 + 0.25 * random.around_zero()) * color);
}

}  // namespace

std::shared_ptr<Mesh> leaves(const std::vector<Shoot>& shoots, const Foliage& foliage,
                             std::size_t count, unsigned seed) {
    const Twigs twigs{shoots};
    Random random{seed, 32};
    LeafArrays arrays;
    for (std::size_t i = 0; i < count; ++i) add_leaf(arrays, twigs.draw(random), foliage, random);
    auto result = mesh(std::move(arrays.quads), std::move(arrays.colors));
    result->set_uvs(std::move(arrays.uvs));
    result->set_alpha(outline(), AlphaMode::mask, 0.5f);
    result->set_color_map(veins());
    return result;
}

}  // namespace opacity::demo
