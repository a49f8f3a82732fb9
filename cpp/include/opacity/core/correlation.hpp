// The correlation coefficient C of two images (thesis, equation 5.2.3.1) in one iteration over
// them, by Welford's update of the means: the sums of products of the thesis's section 5.2.4 lose
// every digit where the mean is far above the deviation.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace opacity {

class Correlation {
   public:
    void add(double x, double y) {
        const double n = double(++count_);
        const double dx = x - mean_x_, dy = y - mean_y_;
        mean_x_ += dx / n;
        mean_y_ += dy / n;
        squares_x_ += dx * (x - mean_x_);
        squares_y_ += dy * (y - mean_y_);
        products_ += dx * (y - mean_y_);
    }

    std::size_t count() const noexcept { return count_; }
    // In [-1, 1], and 1 where either image is constant: it tells nothing that the other does not.
    double coefficient() const {
        if (!(squares_x_ > 0.0 && squares_y_ > 0.0)) return 1.0;
        return std::clamp(products_ / (std::sqrt(squares_x_) * std::sqrt(squares_y_)), -1.0, 1.0);
    }

   private:
    std::size_t count_ = 0;
    double mean_x_ = 0.0, mean_y_ = 0.0;
    double squares_x_ = 0.0, squares_y_ = 0.0, products_ = 0.0;  // of the distances to the means
};

}  // namespace opacity
