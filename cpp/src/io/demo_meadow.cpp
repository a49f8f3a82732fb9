#include "io/demo_meadow.hpp"

#include <algorithm>
#include <array>

#include "io/demo_noise.hpp"
#include "io/demo_strands.hpp"
#include "io/random.hpp"

namespace opacity::demo {
namespace {

constexpr std::size_t blade_segments = 6;
constexpr float blade_opacity = 0.85f;
constexpr double blades_of_a_tuft = 22.0;
const glm::dvec3 wind{0.85, 0.35, 0.0};

struct Blade {
    glm::dvec3 root, heading;
    double length, width, droop;
    glm::dvec3 root_color, tip_color;
    bool has_seeds;  // an ear at its end, on a thin stalk
};

class Field {
   public:
    Field(const Meadow& meadow, std::size_t segments, unsigned seed)
        : meadow_{meadow},
          radius_{meadow_radius(meadow, segments)},
          noise_{seed, 21},
          random_{seed, 22},
          tufts_(tuft_count(segments)) {
        for (Tuft& tuft : tufts_) tuft = new_tuft();
    }

    Blade blade() {
        const Tuft& tuft = tufts_[std::size_t(random_.uniform() * double(tufts_.size()))];
        const glm::dvec2 from_tuft{random_.around_zero(), random_.around_zero()};
        const glm::dvec2 place = tuft.place + tuft.spread * from_tuft;
        const double wide = 0.012, fine = 0.05;  // per centimetre
        const glm::dvec3 at{place, 0.0};
        const double lush = noise_.at(wide * at), gust = noise_.at(wide * at + 40.0);
        const glm::dvec3 stray = random_.unit_vector();
        Blade blade;
        blade.root = at;
        // From the tuft outward, each its own way, and with the wind.
        blade.heading =
            glm::normalize(glm::dvec3{0.30 * from_tuft, 1.0} +
                           0.22 * glm::dvec3{stray.x, stray.y, 0.0} + (0.12 + 0.14 * gust) * wind);
        blade.length = meadow_.height * (1.0 + 0.35 * lush + 0.45 * random_.around_zero());
        blade.width = meadow_.width * (1.0 + 0.3 * random_.around_zero());
        blade.droop = meadow_.droop * random_.uniform(0.5, 1.5) + 0.25 * std::max(0.0, gust);
        blade.has_seeds = random_.uniform() < 0.2 * meadow_.straw;
        dye(blade, noise_.at(fine * at - 40.0));
        if (blade.has_seeds) {
            blade.length *= 1.4;
            blade.droop *= 0.5;
        }
        return blade;
    }

    // Leaves as its heading says, then yields to its weight and to the wind.
    StrandArrays::Point point(const Blade& blade, std::size_t i) const {
        const double t = double(i) / double(blade_segments), s = blade.length * t;
        const glm::dvec3 away = blade.heading + 0.3 * wind;
        const glm::dvec3 flat{away.x, away.y, 0.0};
        const double bend = blade.droop * t * t;
        glm::dvec3 p = blade.root + s * blade.heading + s * bend * (0.9 * flat);
        p.z = std::max(0.1, p.z - s * bend * (0.35 + 0.25 * t));
        if (i == 0) p.z = 0.0;
        const double leaf = 1.15 * (1.0 - t) * (0.75 + 1.1 * t);  // tapered, fullest near the root
        const double ear = t < 0.75 ? 0.3 : t < 0.95 ? 1.5 : 0.5;
        return {p, blade.width * (blade.has_seeds ? ear : std::max(leaf, 0.06)),
                blade.root_color + t * (blade.tip_color - blade.root_color)};
    }

   private:
    struct Tuft {
        glm::dvec2 place{0.0};
        double spread = 0.0;
    };

    static std::size_t tuft_count(std::size_t segments) {
        return std::size_t(double(segments) / double(blade_segments) / blades_of_a_tuft) + 1;
    }

    // In a round patch with a ragged edge.
    Tuft new_tuft() {
        for (;;) {
            const double x = random_.uniform(-1.0, 1.0), y = random_.uniform(-1.0, 1.0);
            const double ragged = 1.0 + 0.25 * noise_.at({2.0 * x, 2.0 * y, 7.5});
            if (x * x + y * y > ragged * ragged) continue;
            const double spread = random_.uniform(3.0, 8.0);
            return {radius_ * glm::dvec2{x, y}, spread};
        }
    }

    void dye(Blade& blade, double patch) {
        const glm::dvec3 deep{0.045, 0.13, 0.02}, fresh{0.2, 0.36, 0.06}, dry{0.5, 0.42, 0.2};
        const double tone = std::clamp(0.5 + 0.5 * patch + 0.5 * random_.around_zero(), 0.0, 1.0);
        const bool is_dry = random_.uniform() < meadow_.straw || blade.has_seeds;
        blade.tip_color = is_dry ? dry : deep + tone * (fresh - deep);
        blade.root_color = 0.45 * (is_dry ? 0.5 * (dry + deep) : blade.tip_color);
    }

    Meadow meadow_;
    double radius_;
    Noise noise_;
    Random random_;
    std::vector<Tuft> tufts_;
};

}  // namespace

double meadow_radius(const Meadow& meadow, std::size_t segments) {
    const double blades = double(segments) / double(blade_segments);
    const double square_centimeters = 1e4 * blades / meadow.blades_per_square_meter;
    return glm::sqrt(square_centimeters / 3.14159);
}

std::shared_ptr<Strands> grass(const Meadow& meadow, std::size_t segments, unsigned seed) {
    Field field{meadow, segments, seed};
    StrandArrays arrays{segments, blade_segments};
    while (!arrays.full()) {
        const Blade blade = field.blade();
        arrays.add([&](std::size_t i) { return field.point(blade, i); });
    }
    return std::move(arrays).strands(blade_opacity);
}

}  // namespace opacity::demo
