/* A right ray/triangle test in C: cc -O2 -o textbook_c textbook.c -lm
   Reads a ray and a triangle a line, writes t,s1,s2,s3: ./textbook_c {rays} {answers} */
#include <math.h>
#include <stdio.h>

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

/* The weight of the corner opposite to the edge from b to a. */
static double weight(const double *a, const double *b, const double *x, const double *n) {
    double edge[3], to_x[3], normal[3];
    sub(a, b, edge);
    sub(x, b, to_x);
    cross(edge, to_x, normal);
    return dot(n, normal) / dot(n, n);
}

int main(int count, char **names) {
    FILE *rays = count > 1 ? fopen(names[1], "r") : stdin;
    FILE *answers = count > 2 ? fopen(names[2], "w") : stdout;
    double v[15];
    while (fscanf(rays, "%lf", &v[0]) == 1) {
        for (int k = 1; k < 15; k++)
            if (fscanf(rays, " ,%lf", &v[k]) != 1) return 1;
        const double *o = v, *d = v + 3, *p1 = v + 6, *p2 = v + 9, *p3 = v + 12;
        double e[3], f[3], n[3], from[3], x[3];
        sub(p3, p1, e);
        sub(p2, p1, f);
        cross(e, f, n);
        sub(o, p1, from);
        double t = -dot(from, n) / dot(d, n);
        for (int k = 0; k < 3; k++) x[k] = o[k] + t * d[k];
        double s1 = weight(p2, p3, x, n), s2 = weight(p3, p1, x, n), s3 = weight(p1, p2, x, n);
        if (t > 0 && s1 >= 0 && s2 >= 0 && s3 >= 0)
            fprintf(answers, "%.17g,%.17g,%.17g,%.17g\n", t, s1, s2, s3);
        else
            fprintf(answers, "inf\n");
    }
    return 0;
}
