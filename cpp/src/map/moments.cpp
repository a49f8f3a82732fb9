#include "map/moments.hpp"

#include <algorithm>
#include <cmath>

namespace opacity {
namespace {

constexpr int most_half = 4;
constexpr double overestimation = 0.25;  // of what may lie at the place itself, or in front of it
constexpr double far = 8.0;              // what lies beyond holds next to nothing
constexpr double least_pivot = 0.1;      // of the bias's part: below, moments are of no layout
constexpr int refinements = 60;

// Moved a little toward the moments of an even layout, so that rounding leaves them possible:
// Muenstermann et al. 2018, table 1, of 4, 6 and 8.
struct Bias {
    double part;
    std::array<double, 2 * most_half> moments;
};
constexpr std::array biases{
    Bias{5e-7, {0, 0.375, 0, 0.375}},
    Bias{5e-6, {0, 0.48, 0, 0.451, 0, 0.45}},
    Bias{5e-5, {0, 0.75, 0, 0.67666666, 0, 0.63, 0, 0.60030303}},
};

using Polynomial = std::array<double, most_half + 1>;  // by powers

double value(const Polynomial& p, int degree, double x) {
    double sum = p[std::size_t(degree)];
    for (int k = degree - 1; k >= 0; --k) sum = sum * x + p[std::size_t(k)];
    return sum;
}

// Polynomials that are orthonormal by the moments, of degrees 0 .. half, by their recurrence:
//     step_k p_(k+1) = (x - middle_k) p_k - step_(k-1) p_(k-1)
// Whatever rounding makes of its numbers, they are those of some layout.
class Orthonormal {
   public:
    // From the Cholesky factor of the matrix b_(i+j), whose pivots are no less than `least`.
    Orthonormal(std::span<const double> b, int half, double least) : half_{std::size_t(half)} {
        std::array<Polynomial, most_half + 1> factor{};
        for (std::size_t i = 0; i <= half_; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                double rest = b[i + j];
                for (std::size_t k = 0; k < j; ++k) rest -= factor[i][k] * factor[j][k];
                factor[i][j] = i == j ? std::sqrt(std::max(rest, least)) : rest / factor[j][j];
            }
        double before = 0.0;
        for (std::size_t k = 0; k < half_; ++k) {
            const double here = factor[k + 1][k] / factor[k][k];
            middle_[k] = here - before;
            step_[k] = factor[k + 1][k + 1] / factor[k][k];
            before = here;
        }
    }

    // All of them at x.
    Polynomial values(double x) const {
        Polynomial p{1.0};
        for (std::size_t k = 0; k < half_; ++k) {
            const double before = k > 0 ? step_[k - 1] * p[k - 1] : 0.0;
            p[k + 1] = ((x - middle_[k]) * p[k] - before) / step_[k];
        }
        return p;
    }
    // The most that may lie at x: Christoffel's number.
    double most_at(double x) const {
        double sum = 0.0;
        for (const double y : values(x)) sum += y * y;
        return 1.0 / sum;
    }
    // The sum of y_k p_k, by powers: where it is 0 the others of a canonical layout lie.
    Polynomial kernel(const Polynomial& y) const {
        Polynomial before{}, here{1.0}, sum{y[0]};
        for (std::size_t k = 0; k < half_; ++k) {
            Polynomial ahead{};
            for (std::size_t i = 0; i <= half_; ++i) {
                const double times_x = i > 0 ? here[i - 1] : 0.0;
                const double less = k > 0 ? step_[k - 1] * before[i] : 0.0;
                ahead[i] = (times_x - middle_[k] * here[i] - less) / step_[k];
                sum[i] += y[k + 1] * ahead[i];
            }
            before = here, here = ahead;
        }
        return sum;
    }

   private:
    std::size_t half_;
    std::array<double, most_half> middle_{}, step_{};
};

using Roots = std::array<double, most_half>;

// Without the digits that the usual formula loses. A root at infinity is far.
Roots quadratic_roots(double c, double b, double a) {
    const double root = std::sqrt(std::max(b * b - 4.0 * a * c, 0.0));
    const double t = -0.5 * (b + std::copysign(root, b));
    const auto quotient = [](double above, double below) {
        return std::abs(above) < far * std::abs(below) ? above / below
                                                       : std::copysign(far, above * below);
    };
    const double first = quotient(t, a), second = t == 0.0 ? first : quotient(c, t);
    return {std::min(first, second), std::max(first, second)};
}

// Where p changes sign between two places, by Newton's steps while they stay between. Only the
// outer roots can be farther.
double root_between(const Polynomial& p, const Polynomial& slope, int degree, double low,
                    double high) {
    const bool rises = value(p, degree, low) < 0.0;
    if (rises == (value(p, degree, high) < 0.0)) return low == -far ? low : high;
    double x = 0.5 * (low + high);
    for (int i = 0; i < refinements; ++i) {
        const double y = value(p, degree, x);
        ((y < 0.0) == rises ? low : high) = x;
        const double former = x;
        x -= y / value(slope, degree - 1, x);
        if (!(x > low && x < high)) x = 0.5 * (low + high);
        if (x == former) break;
    }
    return x;
}

// All of them, in their order, between those of the derivative.
Roots roots_of(const Polynomial& p, int degree) {
    if (degree == 2) return quadratic_roots(p[0], p[1], p[2]);
    Polynomial slope{};
    for (int k = 1; k <= degree; ++k) slope[std::size_t(k - 1)] = k * p[std::size_t(k)];
    const Roots turns = roots_of(slope, degree - 1);
    Roots roots{};
    for (int i = 0; i < degree; ++i) {
        const double low = i > 0 ? turns[std::size_t(i - 1)] : -far;
        const double high = i + 1 < degree ? turns[std::size_t(i)] : far;
        roots[std::size_t(i)] = root_between(p, slope, degree, low, high);
    }
    return roots;
}

}  // namespace

// Over an interval of half length h about m, means A and differences D over it, by its length, of
// one power after the other: z^(k+1) has the mean m A + h^2 D and the difference m D + A, which is
// k + 1 times the mean of z^k.
void PowerMoments::of_caster(float begin, float end, std::span<float> c) const {
    const float m = begin + end - 1.f, h = end - begin;
    float mean = 1.f, difference = 0.f;
    for (std::size_t k = 0; k < c.size(); ++k) {
        const float ahead = m * difference + mean;
        c[k] = ahead / float(k + 1);
        mean = m * mean + h * h * difference;
        difference = ahead;
    }
}

// Rounding is that of all the texel holds, also of what was taken out.
float PowerMoments::optical_depth_before(float x, std::span<const float> c, float all) const {
    if (!(c[0] > 0.f)) return 0.f;
    const Bias& bias = biases[std::size_t(half_ - 2)];
    const double part_of_bias = std::min(bias.part * std::max(double(all) / c[0], 1.0), 1.0);
    std::array<double, 2 * most_half + 1> b{1.0};
    for (std::size_t k = 1; k < c.size(); ++k)
        b[k] =
            (1.0 - part_of_bias) * double(c[k]) / double(c[0]) + part_of_bias * bias.moments[k - 1];
    const Orthonormal polynomials{b, half_, least_pivot * part_of_bias};
    const double z = 2.0 * double(x) - 1.0;
    const Roots others = roots_of(polynomials.kernel(polynomials.values(z)), half_);
    double part = overestimation * polynomials.most_at(z);
    for (int i = 0; i < half_; ++i)
        if (const double at = others[std::size_t(i)]; at < z) part += polynomials.most_at(at);
    return c[0] * float(part);
}

}  // namespace opacity
