// A right ray/triangle test in Java: javac Textbook.java
// Reads standard input and writes standard output: reftrace judge --run 'java -cp . Textbook'
import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.PrintWriter;

public class Textbook {
    static double[] sub(double[] a, double[] b) {
        return new double[] {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    }

    static double[] cross(double[] a, double[] b) {
        return new double[] {
            a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }

    static double dot(double[] a, double[] b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    static double weight(double[] a, double[] b, double[] x, double[] n) {
        return dot(n, cross(sub(a, b), sub(x, b))) / dot(n, n);
    }

    public static void main(String[] none) throws IOException {
        BufferedReader rays = new BufferedReader(new InputStreamReader(System.in));
        PrintWriter answers = new PrintWriter(System.out);
        String line;
        while ((line = rays.readLine()) != null) {
            String[] words = line.split(",");
            double[][] v = new double[5][3];
            for (int k = 0; k < 15; k++) v[k / 3][k % 3] = Double.parseDouble(words[k]);
            double[] o = v[0], d = v[1], p1 = v[2], p2 = v[3], p3 = v[4];
            double[] n = cross(sub(p3, p1), sub(p2, p1));
            double t = -dot(sub(o, p1), n) / dot(d, n);
            double[] x = {o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]};
            double s1 = weight(p2, p3, x, n), s2 = weight(p3, p1, x, n), s3 = weight(p1, p2, x, n);
            if (t > 0 && s1 >= 0 && s2 >= 0 && s3 >= 0) {
                answers.println(t + "," + s1 + "," + s2 + "," + s3);
            } else {
                answers.println("inf");
            }
        }
        answers.flush();
    }
}
