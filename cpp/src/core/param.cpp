#include "opacity/core/param.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>

#include "core/number_text.hpp"
#include "opacity/core/error.hpp"
#include "opacity/core/nearest_name.hpp"

namespace opacity {
namespace {

// Numbers cross freely where nothing is lost: 1 is a float, 2.0 is an int, true is neither.
bool as_double(const ParamValue& value, double& number) {
    if (const auto* i = std::get_if<std::int64_t>(&value)) return number = double(*i), true;
    if (const auto* d = std::get_if<double>(&value)) return number = *d, true;
    return false;
}

}  // namespace

std::string to_string(const ParamValue& value) {
    if (const auto* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
    if (const auto* i = std::get_if<std::int64_t>(&value)) return std::to_string(*i);
    if (const auto* d = std::get_if<double>(&value)) return number_text(*d);
    return "\"" + std::get<std::string>(value) + "\"";
}

ParamBase::ParamBase(ParamOwner& owner, std::string name, std::string doc)
    : Source{std::move(name)}, owner_{owner}, doc_{std::move(doc)} {
    owner.params_.push_back(this);
}

void ParamBase::reject(const ParamValue& value, const std::string& problem) const {
    throw ParameterError(
        owner_.name() + "." + name() + " = " + to_string(value) + " is " + problem,
        "choose " + range() + "; " + owner_.listed_by_ + " lists every parameter with its range");
}

void ParamBase::reject_type(const ParamValue& value) const {
    reject(value, std::string{"not "} + (type().starts_with("int") ? "an " : "a ") + type());
}

ParamBase& ParamOwner::param(std::string_view name) const {
    std::vector<std::string> names;
    for (ParamBase* param : params_) {
        if (param->name() == name) return *param;
        names.push_back(param->name());
    }
    const std::string list = std::accumulate(
        names.begin(), names.end(), std::string{},
        [](const std::string& a, const std::string& b) { return a.empty() ? b : a + ", " + b; });
    const std::string nearest = nearest_name(name, names);
    throw ParameterError(name_ + " has no parameter \"" + std::string{name} + "\"",
                         nearest.empty() ? "it has no parameters: leave it out"
                                         : "did you mean \"" + nearest + "\"? It has " + list);
}

template <>
std::string Param<int>::type() const {
    return "int";
}
template <>
std::string Param<double>::type() const {
    return "float";
}
template <class T>
std::string Param<T>::range() const {
    return number_text(double(range_.min)) + ".." + number_text(double(range_.max));
}
template <>
ParamValue Param<int>::value() const {
    return std::int64_t{value_};
}
template <>
ParamValue Param<double>::value() const {
    return value_;
}
template <>
ParamValue Param<int>::default_value() const {
    return std::int64_t{default_};
}
template <>
ParamValue Param<double>::default_value() const {
    return default_;
}

template <class T>
void Param<T>::assign(const ParamValue& value) {
    double number = 0.0;
    if (!as_double(value, number)) reject_type(value);
    if (!(number >= double(range_.min) && number <= double(range_.max)))
        reject(value, "outside " + range());
    const T converted = static_cast<T>(number);
    if (double(converted) != number) reject_type(value);
    if (converted == value_) return;
    value_ = converted;
    touch();
}

template <>
void Param<int>::feed(Feeder& feeder) const {
    feeder.uniform("u_" + name(), value_);
}
template <>
void Param<double>::feed(Feeder& feeder) const {
    feeder.uniform("u_" + name(), float(value_));
}

template class Param<int>;
template class Param<double>;

void Param<bool>::assign(const ParamValue& value) {
    const auto* b = std::get_if<bool>(&value);
    if (!b) reject_type(value);
    if (*b == value_) return;
    value_ = *b;
    touch();
}

std::string Choice::range() const {
    std::string list;
    for (const std::string& choice : choices_)
        list += (list.empty() ? "\"" : ", \"") + choice + "\"";
    return list;
}

void Choice::assign(const ParamValue& value) {
    const auto* text = std::get_if<std::string>(&value);
    const auto* number = std::get_if<std::int64_t>(&value);  // of a choice that is one
    const std::string word = text ? *text : number ? std::to_string(*number) : "";
    const auto index = std::size_t(std::ranges::find(choices_, word) - choices_.begin());
    if (index == choices_.size()) reject(value, "not one of " + range());
    if (index == index_) return;
    index_ = index;
    touch();
}

std::string IntChoice::range() const {
    std::string list;
    for (int choice : choices_) list += (list.empty() ? "" : ", ") + std::to_string(choice);
    return list;
}

void IntChoice::assign(const ParamValue& value) {
    double number = 0.0;
    if (!as_double(value, number)) reject_type(value);
    const auto found = std::find_if(choices_.begin(), choices_.end(),
                                    [&](int choice) { return double(choice) == number; });
    if (found == choices_.end()) reject(value, "not one of " + range());
    const auto index = std::size_t(found - choices_.begin());
    if (index == index_) return;
    index_ = index;
    touch();
}

template <>
std::string AutoParam<int>::type() const {
    return "int or \"auto\"";
}
template <>
std::string AutoParam<double>::type() const {
    return "float or \"auto\"";
}
template <class T>
std::string AutoParam<T>::number_range() const {
    return number_text(double(range_.min)) + ".." + number_text(double(range_.max));
}
template <class T>
std::string AutoParam<T>::range() const {
    return "\"auto\" or " + number_range();
}
template <class T>
ParamValue AutoParam<T>::shown(T value) {
    if (value < T(0)) return std::string{"auto"};
    if constexpr (std::is_same_v<T, int>)
        return std::int64_t{value};
    else
        return value;
}

template <class T>
void AutoParam<T>::assign(const ParamValue& value) {
    T converted = automatic;
    double number = 0.0;
    if (const auto* text = std::get_if<std::string>(&value)) {
        if (*text != "auto") reject_type(value);
    } else if (!as_double(value, number)) {
        reject_type(value);
    } else if (!(number >= double(range_.min) && number <= double(range_.max))) {
        reject(value, "outside " + number_range());
    } else {
        converted = static_cast<T>(number);
        if (double(converted) != number) reject_type(value);
    }
    if (converted == value_) return;
    value_ = converted;
    touch();
}

template <>
void AutoParam<int>::feed(Feeder& feeder) const {
    feeder.uniform("u_" + name(), value_);
}
template <>
void AutoParam<double>::feed(Feeder& feeder) const {
    feeder.uniform("u_" + name(), float(value_));
}

template class AutoParam<int>;
template class AutoParam<double>;

}  // namespace opacity
