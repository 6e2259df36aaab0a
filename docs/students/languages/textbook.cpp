// A right ray/triangle test in C++: c++ -O2 -o textbook_cpp textbook.cpp
// Reads float64 numbers as they lie in memory, 15 a ray, and writes 4 for each answer:
//   reftrace judge --run './textbook_cpp {rays} {answers}' --exchange raw
#include <array>
#include <fstream>
#include <limits>

using Vector = std::array<double, 3>;

static Vector operator-(const Vector &a, const Vector &b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

static Vector cross(const Vector &a, const Vector &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

static double dot(const Vector &a, const Vector &b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct Pair {
    Vector o, d, p1, p2, p3;
};

int main(int, char **names) {
    std::ifstream rays(names[1], std::ios::binary);
    std::ofstream answers(names[2], std::ios::binary);
    Pair r;
    while (rays.read(reinterpret_cast<char *>(&r), sizeof r)) {
        const Vector n = cross(r.p3 - r.p1, r.p2 - r.p1);
        double t = -dot(r.o - r.p1, n) / dot(r.d, n);
        Vector x;
        for (int k = 0; k < 3; k++) x[k] = r.o[k] + t * r.d[k];
        const double s1 = dot(n, cross(r.p2 - r.p3, x - r.p3)) / dot(n, n);
        const double s2 = dot(n, cross(r.p3 - r.p1, x - r.p1)) / dot(n, n);
        const double s3 = dot(n, cross(r.p1 - r.p2, x - r.p2)) / dot(n, n);
        if (!(t > 0 && s1 >= 0 && s2 >= 0 && s3 >= 0)) t = std::numeric_limits<double>::infinity();
        const double out[4] = {t, s1, s2, s3};
        answers.write(reinterpret_cast<const char *>(out), sizeof out);
    }
}
