// Arithmetic of three numbers, in whichever precision they come.
#pragma once

#include <array>
#include <cmath>

namespace opacity {

template <class T>
using Vector = std::array<T, 3>;

template <class T>
T dot(const Vector<T>& a, const Vector<T>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T>
Vector<T> plus(const Vector<T>& a, const Vector<T>& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T>
Vector<T> minus(const Vector<T>& a, const Vector<T>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T>
Vector<T> scaled(const Vector<T>& v, T factor) {
    return {v[0] * factor, v[1] * factor, v[2] * factor};
}
template <class T>
T length(const Vector<T>& v) {
    return std::sqrt(dot(v, v));
}
// However far apart: no square overflows.
template <class T>
T distance(const Vector<T>& a, const Vector<T>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace opacity
