// A right ray/triangle test in Rust: rustc -O -o textbook_rs textbook.rs
//   reftrace judge --run './textbook_rs {rays} {answers}'
use std::fmt::Write;
use std::{env, fs};

type Vector = [f64; 3];

fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn main() {
    let names: Vec<String> = env::args().collect();
    let mut out = String::new();
    for line in fs::read_to_string(&names[1]).unwrap().lines() {
        let v: Vec<f64> = line.split(',').map(|w| w.parse().unwrap()).collect();
        let at = |k: usize| -> Vector { [v[k], v[k + 1], v[k + 2]] };
        let (o, d, p1, p2, p3) = (at(0), at(3), at(6), at(9), at(12));
        let n = cross(sub(p3, p1), sub(p2, p1));
        let t = -dot(sub(o, p1), n) / dot(d, n);
        let x = [o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]];
        let weight = |a, b| dot(n, cross(sub(a, b), sub(x, b))) / dot(n, n);
        let (s1, s2, s3) = (weight(p2, p3), weight(p3, p1), weight(p1, p2));
        if t > 0.0 && s1 >= 0.0 && s2 >= 0.0 && s3 >= 0.0 {
            writeln!(out, "{t},{s1},{s2},{s3}").unwrap();
        } else {
            out.push_str("inf\n");
        }
    }
    fs::write(&names[2], out).unwrap();
}
