#include "io/demo_triangles.hpp"

#include <utility>

namespace opacity::demo {

void Triangles::band(std::uint32_t low, std::uint32_t high, std::uint32_t points) {
    for (std::uint32_t i = 0; i < points; ++i) {
        const std::uint32_t next = (i + 1) % points;
        quad(low + i, low + next, high + next, high + i);
    }
}

std::shared_ptr<Mesh> mesh(Triangles triangles, std::vector<float3> color) {
    return std::make_shared<Mesh>(Positions{std::move(triangles.xyz)}, std::move(triangles.indices),
                                  std::vector<float3>{}, std::vector{1.f}, std::move(color));
}

void add_ball(Triangles& mesh, int n,
              const std::function<glm::dvec3(const glm::dvec3& direction)>& surface) {
    constexpr std::uint32_t absent = 0xFFFF'FFFF;
    std::vector<std::uint32_t> known(std::size_t((n + 1) * (n + 1) * (n + 1)), absent);
    const auto vertex = [&](glm::ivec3 cell) {
        std::uint32_t& index = known[std::size_t((cell.x * (n + 1) + cell.y) * (n + 1) + cell.z)];
        if (index != absent) return index;
        const glm::dvec3 u = 2.0 * glm::dvec3{cell} / double(n) - 1.0;
        const glm::dvec3 even =
            u * (0.785 + 0.215 * u * u);  // about tan(pi/4 u): cells of one size
        return index = mesh.add(surface(glm::normalize(even)));
    };
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side <= n; side += n)
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const auto at = [&](int di, int dj) {
                        glm::ivec3 cell;
                        cell[axis] = side;
                        cell[(axis + 1) % 3] = side ? i + di : i + dj;  // counter-clockwise outside
                        cell[(axis + 2) % 3] = side ? j + dj : j + di;
                        return vertex(cell);
                    };
                    mesh.quad(at(0, 0), at(1, 0), at(1, 1), at(0, 1));
                }
}

std::vector<glm::dvec2> unit_circle(int points) {
    std::vector<glm::dvec2> circle;
    const int quarter = points / 4;
    for (int i = 0; i < 4 * quarter; ++i) {
        const double t = double(i % quarter) / quarter;
        glm::dvec2 p{(1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t)};
        for (int turn = 0; turn < i / quarter; ++turn) p = {-p.y, p.x};
        circle.push_back(p);
    }
    return circle;
}

void add_revolved(Triangles& mesh, const std::vector<glm::dvec2>& profile, int around) {
    const std::vector<glm::dvec2> circle = unit_circle(around);
    const auto count = static_cast<std::uint32_t>(circle.size());
    for (std::size_t i = 0; i < profile.size(); ++i) {
        for (const glm::dvec2& c : circle)
            mesh.add({profile[i].x * c.x, profile[i].x * c.y, profile[i].y});
        if (i > 0) mesh.band(mesh.count() - 2 * count, mesh.count() - count, count);
    }
}

std::shared_ptr<Mesh> ground(double half_side, float3 color) {
    constexpr int n = 24;
    Triangles square;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            square.add({half_side * (2.0 * i / n - 1.0), half_side * (2.0 * j / n - 1.0), 0.0});
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i, b = a + n + 1;
            square.quad(a, a + 1, b + 1, b);
        }
    auto shape = mesh(std::move(square), {color});
    shape->set_casts(false);
    return shape;
}

}  // namespace opacity::demo
