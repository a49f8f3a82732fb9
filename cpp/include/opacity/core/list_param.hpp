// A parameter that is one of several words, or a list of numbers above 0: "linear", or "1,2,4".
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "opacity/core/param_owner.hpp"

namespace opacity {

class ListParam : public ParamBase {
   public:
    ListParam(ParamOwner& owner, std::string name, std::vector<std::string> words, std::string doc)
        : ParamBase{owner, std::move(name), std::move(doc)},
          words_{std::move(words)},
          text_{words_.front()} {}

    bool is(std::string_view word) const noexcept { return text_ == word; }
    // Empty where it is a word.
    std::span<const double> numbers() const noexcept { return numbers_; }
    std::string type() const override { return "choice or list"; }
    std::string range() const override;
    ParamValue value() const override { return text_; }
    ParamValue default_value() const override { return words_.front(); }
    void assign(const ParamValue& value) override;

   private:
    std::vector<std::string> words_;  // the default first
    std::string text_;
    std::vector<double> numbers_;
};

}  // namespace opacity
