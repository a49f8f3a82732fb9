#include "io/demo_branches.hpp"

#include <algorithm>
#include <cmath>

namespace opacity::demo {
namespace {

const glm::dvec3 up{0.0, 0.0, 1.0};

struct LevelHabit {
    std::size_t segments;
    double stray, rise;  // of the heading, a segment
    int sides;           // of its tube
};
constexpr LevelHabit habits[] = {
    {24, 0.05, 0.05, 16}, {12, 0.13, 0.03, 8}, {7, 0.17, 0.03, 4}, {4, 0.2, 0.02, 4}};

Shoot grown(int level, const glm::dvec3& root, const glm::dvec3& direction, double length,
            double radius, Random& random) {
    const LevelHabit& habit = habits[level];
    Shoot shoot{level, length, radius, {root}};
    glm::dvec3 heading = glm::normalize(direction);
    for (std::size_t i = 0; i < habit.segments; ++i) {
        const glm::dvec3 stray = random.unit_vector();
        heading = glm::normalize(heading + habit.stray * stray + habit.rise * up);
        shoot.points.push_back(shoot.points.back() + length / double(habit.segments) * heading);
    }
    return shoot;
}

// Shoots leave a stem one after the other, each turned on by the golden angle.
class Spiral {
   public:
    explicit Spiral(Random& random) {
        const glm::dvec3 start = random.unit_vector();
        turn_ = glm::normalize(glm::dvec2{start.x, start.y} + glm::dvec2{1e-3, 0.0});
    }
    glm::dvec3 next(const glm::dvec3& stem) {
        constexpr double c = -0.7373688780783197, s = 0.6754902942615239;
        turn_ = glm::normalize(glm::dvec2{c * turn_.x - s * turn_.y, s * turn_.x + c * turn_.y});
        const glm::dvec3 x = across(stem, {1.0, 0.0, 0.0});
        return turn_.x * x + turn_.y * glm::cross(stem, x);
    }

   private:
    glm::dvec2 turn_;
};

double tapered(const Shoot& shoot, double t) {
    const double taper = shoot.radius * (1.0 - 0.85 * t);
    if (shoot.level > 0) return taper;
    const double flare = std::max(0.0, 1.0 - 9.0 * t);  // where the roots begin
    return taper * (1.0 + 0.7 * flare * flare);
}

void add_children(std::vector<Shoot>& shoots, std::size_t parent_index, std::size_t count,
                  Random& random) {
    Spiral spiral{random};
    for (std::size_t i = 0; i < count; ++i) {
        const Shoot& parent = shoots[parent_index];
        const double t = 0.22 + 0.76 * (double(i) + 0.7 * random.uniform()) / double(count);
        const glm::dvec3 stem = parent.tangent(t);
        const glm::dvec3 direction = 0.75 * stem + spiral.next(stem) + 0.12 * up;
        const double length = parent.length * (0.62 - 0.3 * t) * (1.0 + 0.3 * random.around_zero());
        const double radius = std::min(0.75 * tapered(parent, t), 0.013 * length + 0.003);
        shoots.push_back(grown(parent.level + 1, parent.at(t), direction, length, radius, random));
    }
}

void add_branches(std::vector<Shoot>& shoots, const TreeShape& shape, Random& random) {
    Spiral spiral{random};
    for (std::size_t i = 0; i < shape.branches; ++i) {
        const Shoot& trunk = shoots.front();
        const double v = (double(i) + 0.6 * random.uniform()) / double(shape.branches);
        const double t = shape.bare + (0.98 - shape.bare) * v, from_widest = (v - 0.28) / 0.75;
        const double crown = std::max(0.15, 1.0 - from_widest * from_widest);
        const double length = shape.spread * crown * (1.0 + 0.2 * random.around_zero());
        const glm::dvec3 stem = trunk.tangent(t);
        const glm::dvec3 direction = spiral.next(stem) + (shape.upward + 0.5 * v) * up;
        const double radius = std::min(0.7 * tapered(trunk, t), 0.02 * length + 0.006);
        shoots.push_back(grown(1, trunk.at(t), direction, length, radius, random));
    }
}

}  // namespace

glm::dvec3 Shoot::at(double t) const {
    const double along = std::clamp(t, 0.0, 1.0) * double(points.size() - 1);
    const std::size_t i = std::min(std::size_t(along), points.size() - 2);
    return points[i] + (along - double(i)) * (points[i + 1] - points[i]);
}

glm::dvec3 Shoot::tangent(double t) const {
    const std::size_t i = std::min(std::size_t(std::clamp(t, 0.0, 1.0) * double(points.size() - 1)),
                                   points.size() - 2);
    return glm::normalize(points[i + 1] - points[i]);
}

glm::dvec3 across(const glm::dvec3& direction, const glm::dvec3& hint) {
    const glm::dvec3 rest = hint - glm::dot(hint, direction) * direction;
    if (glm::dot(rest, rest) > 1e-3) return glm::normalize(rest);
    return across(direction, std::abs(direction.x) < 0.7 ? glm::dvec3{1.0, 0.0, 0.0}
                                                         : glm::dvec3{0.0, 1.0, 0.0});
}

std::vector<Shoot> grow(const TreeShape& shape, Random& random) {
    std::vector<Shoot> shoots{
        grown(0, glm::dvec3{0.0}, up, shape.height, 0.022 * shape.height, random)};
    add_branches(shoots, shape, random);
    const std::size_t children[] = {0, shape.branches_of_a_branch, shape.twigs_of_those, 0};
    for (std::size_t i = 1; i < shoots.size(); ++i)
        add_children(shoots, i, children[shoots[i].level], random);
    return shoots;
}

void add_shoot(Triangles& mesh, const Shoot& shoot) {
    const std::vector<glm::dvec2> circle = unit_circle(habits[shoot.level].sides);
    const auto around = static_cast<std::uint32_t>(circle.size());
    const std::size_t segments = shoot.points.size() - 1;
    glm::dvec3 x{1.0, 0.0, 0.0};
    for (std::size_t i = 0; i < segments; ++i) {
        const double t = double(i) / double(segments), radius = tapered(shoot, t);
        const glm::dvec3 tangent = shoot.tangent(t);
        x = across(tangent, x);  // carried on, so that the tube does not twist
        const glm::dvec3 y = glm::cross(tangent, x);
        for (const glm::dvec2& c : circle) mesh.add(shoot.points[i] + radius * (c.x * x + c.y * y));
        if (i > 0) mesh.band(mesh.count() - 2 * around, mesh.count() - around, around);
    }
    const std::uint32_t last = mesh.count() - around, tip = mesh.add(shoot.points.back());
    for (std::uint32_t i = 0; i < around; ++i)
        mesh.triangle(last + i, last + (i + 1) % around, tip);
}

}  // namespace opacity::demo
