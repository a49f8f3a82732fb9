#include <iostream>
#include <opacity/opacity.hpp>
#include <vector>

int main() {
    const std::vector<float> xyz = {0, 0, 0, 0, 1, 0, 0, 2, 0};
    const opacity::Strands strands{opacity::Positions{xyz}, {0, 3}};
    std::cout << opacity::version() << ' ' << strands.strand_count() << ' '
              << strands.segments().size() << '\n';
}
