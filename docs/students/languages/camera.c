/* Right camera rays in C: cc -O2 -o camera_c camera.c -lm
   Reads a pixel and its camera a line, writes dx,dy,dz,ox,oy,oz: ./camera_c {rays} {answers} */
#include <stdio.h>

int main(int count, char **names) {
    FILE *pixels = count > 1 ? fopen(names[1], "r") : stdin;
    FILE *answers = count > 2 ? fopen(names[2], "w") : stdout;
    double v[22];
    while (fscanf(pixels, "%lf", &v[0]) == 1) {
        for (int k = 1; k < 22; k++)
            if (fscanf(pixels, " ,%lf", &v[k]) != 1) return 1;
        const double column = v[0], row = v[1], columns = v[2], rows = v[3];
        const double lens = v[5], sensor = v[6], scale = v[7];
        const double *matrix = v + 10; /* row by row: right, up, back, position */
        const int is_orthographic = v[4] != 0;
        const double longer = columns > rows ? columns : rows;
        const double pixel = (is_orthographic ? scale : sensor / lens) / longer;
        const double x = (column + 0.5 - columns / 2 + v[8] * longer) * pixel;
        const double y = (row + 0.5 - rows / 2 + v[9] * longer) * pixel;
        double direction[3], origin[3];
        for (int k = 0; k < 3; k++) {
            const double *m = matrix + 4 * k;
            const double across = x * m[0] + y * m[1];
            direction[k] = (is_orthographic ? 0 : across) - m[2];
            origin[k] = m[3] + (is_orthographic ? across : 0);
        }
        fprintf(answers, "%.17g,%.17g,%.17g,", direction[0], direction[1], direction[2]);
        fprintf(answers, "%.17g,%.17g,%.17g\n", origin[0], origin[1], origin[2]);
    }
    return 0;
}
