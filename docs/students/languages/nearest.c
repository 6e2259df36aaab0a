/* Right nearest hits in C: cc -O2 -o nearest_c nearest.c -lm
   Reads a ray and five objects a line, writes t,object: ./nearest_c {rays} {answers} */
#include <math.h>
#include <stdio.h>

enum { OBJECTS = 5, NUMBERS = 6 + 13 * OBJECTS };

static void sub(const double *a, const double *b, double *out) {
    for (int k = 0; k < 3; k++) out[k] = a[k] - b[k];
}

static void cross(const double *a, const double *b, double *out) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* On which side of the edge from b to a the point x lies, as n sees it: 0 or more is inside. */
static double side(const double *a, const double *b, const double *x, const double *n) {
    double edge[3], to_x[3], normal[3];
    sub(a, b, edge);
    sub(x, b, to_x);
    cross(edge, to_x, normal);
    return dot(n, normal);
}

static double intersect(const double *o, const double *d, const double *p) {
    const double *p1 = p, *p2 = p + 3, *p3 = p + 6;
    double e[3], f[3], n[3], from[3], x[3];
    sub(p3, p1, e);
    sub(p2, p1, f);
    cross(e, f, n);
    sub(o, p1, from);
    const double t = -dot(from, n) / dot(d, n);
    for (int k = 0; k < 3; k++) x[k] = o[k] + t * d[k];
    const int inside = side(p2, p3, x, n) >= 0 && side(p3, p1, x, n) >= 0 && side(p1, p2, x, n) >= 0;
    return t > 0 && inside ? t : INFINITY;
}

int main(int count, char **names) {
    FILE *rays = count > 1 ? fopen(names[1], "r") : stdin;
    FILE *answers = count > 2 ? fopen(names[2], "w") : stdout;
    double v[NUMBERS];
    while (fscanf(rays, "%lf", &v[0]) == 1) {
        for (int k = 1; k < NUMBERS; k++)
            if (fscanf(rays, " ,%lf", &v[k]) != 1) return 1;
        const double *triangles = v + 6, *scales = triangles + 9 * OBJECTS;
        const double *positions = scales + OBJECTS;
        double best = INFINITY;
        int found = 0;
        for (int k = 0; k < OBJECTS; k++) {
            double own[3], d[3]; /* the ray in the object's space: t is the same there */
            for (int j = 0; j < 3; j++) {
                own[j] = (v[j] - positions[3 * k + j]) / scales[k];
                d[j] = v[3 + j] / scales[k];
            }
            const double t = intersect(own, d, triangles + 9 * k);
            if (t < best) {
                best = t;
                found = k;
            }
        }
        fprintf(answers, "%.17g,%d\n", best, found);
    }
    return 0;
}
