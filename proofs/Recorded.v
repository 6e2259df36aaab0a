(** What the tracer's own functions were seen to compute: written by `tools/record_trees.py`.

    Do not edit. Each definition is an expression of Trees.v. Its variables are the function's
    inputs, and its constants the numbers that were used. The names of functions are those in
    `addon/`. A definition that ends in _path is what the function asked of its numbers on the way,
    as it was answered: the others hold where that does. `tests/proof/test_bridge.py` records them
    anew, and fails if they are no longer these. *)
Require Import ZArith String.
From Reftrace Require Import Trees.
Open Scope Z_scope.
Open Scope string_scope.

(** bounds.FromPoint.edges: ab *)
Definition from_point_ab : expr :=
  let x1 := Sub (Var "ay") (Var "oy") in
  let x2 := Sub (Var "bz") (Var "az") in
  let x3 := Sub (Var "az") (Var "oz") in
  let x4 := Sub (Var "by") (Var "ay") in
  let x5 := Sub (Var "bx") (Var "ax") in
  let x6 := Sub (Var "ax") (Var "ox") in
  Add (Add (Mul (Sub (Mul x1 x2) (Mul x3 x4)) (Var "dx")) (Mul (Sub (Mul x3 x5) (Mul x6 x2))
    (Var "dy"))) (Mul (Sub (Mul x6 x4) (Mul x1 x5)) (Var "dz")).

(** bounds.FromPoint.edges: bc *)
Definition from_point_bc : expr :=
  let x1 := Sub (Var "by") (Var "oy") in
  let x2 := Sub (Var "cz") (Var "bz") in
  let x3 := Sub (Var "bz") (Var "oz") in
  let x4 := Sub (Var "cy") (Var "by") in
  let x5 := Sub (Var "cx") (Var "bx") in
  let x6 := Sub (Var "bx") (Var "ox") in
  Add (Add (Mul (Sub (Mul x1 x2) (Mul x3 x4)) (Var "dx")) (Mul (Sub (Mul x3 x5) (Mul x6 x2))
    (Var "dy"))) (Mul (Sub (Mul x6 x4) (Mul x1 x5)) (Var "dz")).

(** bounds.FromPoint.edges: ca *)
Definition from_point_ca : expr :=
  let x1 := Sub (Var "cy") (Var "oy") in
  let x2 := Sub (Var "az") (Var "cz") in
  let x3 := Sub (Var "cz") (Var "oz") in
  let x4 := Sub (Var "ay") (Var "cy") in
  let x5 := Sub (Var "ax") (Var "cx") in
  let x6 := Sub (Var "cx") (Var "ox") in
  Add (Add (Mul (Sub (Mul x1 x2) (Mul x3 x4)) (Var "dx")) (Mul (Sub (Mul x3 x5) (Mul x6 x2))
    (Var "dy"))) (Mul (Sub (Mul x6 x4) (Mul x1 x5)) (Var "dz")).

(** bounds.FromPoint.edges: error *)
Definition from_point_error : expr :=
  let x1 := Abs (Sub (Var "ay") (Var "oy")) in
  let x2 := Abs (Sub (Var "bz") (Var "az")) in
  let x3 := Abs (Sub (Var "az") (Var "oz")) in
  let x4 := Abs (Sub (Var "by") (Var "ay")) in
  let x5 := Abs (Sub (Var "by") (Var "oy")) in
  let x6 := Abs (Sub (Var "cz") (Var "bz")) in
  let x7 := Abs (Sub (Var "bz") (Var "oz")) in
  let x8 := Abs (Sub (Var "cy") (Var "by")) in
  let x9 := Abs (Sub (Var "cy") (Var "oy")) in
  let x10 := Abs (Sub (Var "az") (Var "cz")) in
  let x11 := Abs (Sub (Var "cz") (Var "oz")) in
  let x12 := Abs (Sub (Var "ay") (Var "cy")) in
  let x13 := Abs (Sub (Var "bx") (Var "ax")) in
  let x14 := Abs (Sub (Var "ax") (Var "ox")) in
  let x15 := Abs (Sub (Var "cx") (Var "bx")) in
  let x16 := Abs (Sub (Var "bx") (Var "ox")) in
  let x17 := Abs (Sub (Var "ax") (Var "cx")) in
  let x18 := Abs (Sub (Var "cx") (Var "ox")) in
  Add (Mul (Num 3 (-51)) (Add (Add (Mul (Var "rx") (Max (Max (Add (Mul x1 x2) (Mul x3 x4)) (Add (Mul
    x5 x6) (Mul x7 x8))) (Add (Mul x9 x10) (Mul x11 x12)))) (Mul (Var "ry") (Max (Max (Add (Mul x3
    x13) (Mul x14 x2)) (Add (Mul x7 x15) (Mul x16 x6))) (Add (Mul x11 x17) (Mul x18 x10))))) (Mul
    (Var "rz") (Max (Max (Add (Mul x14 x4) (Mul x1 x13)) (Add (Mul x16 x8) (Mul x5 x15))) (Add (Mul
    x18 x12) (Mul x9 x17)))))) (Mul (Num 1 (-1060)) (Add (Add (Add (Num 1 0) (Var "rx")) (Var "ry"))
    (Var "rz"))).

(** bounds.FromPoint.fractions: T *)
Definition from_point_T : expr :=
  let x1 := Sub (Var "by") (Var "ay") in
  let x2 := Sub (Var "cz") (Var "az") in
  let x3 := Sub (Var "bz") (Var "az") in
  let x4 := Sub (Var "cy") (Var "ay") in
  let x5 := Sub (Var "cx") (Var "ax") in
  let x6 := Sub (Var "bx") (Var "ax") in
  Add (Add (Mul (Sub (Var "ax") (Var "ox")) (Sub (Mul x1 x2) (Mul x3 x4))) (Mul (Sub (Var "ay")
    (Var "oy")) (Sub (Mul x3 x5) (Mul x6 x2)))) (Mul (Sub (Var "az") (Var "oz")) (Sub (Mul x6 x4)
    (Mul x1 x5))).

(** bounds.FromPoint.fractions: T error *)
Definition from_point_T_error : expr :=
  let x1 := Abs (Sub (Var "ax") (Var "ox")) in
  let x2 := Abs (Sub (Var "by") (Var "ay")) in
  let x3 := Abs (Sub (Var "cz") (Var "az")) in
  let x4 := Abs (Sub (Var "bz") (Var "az")) in
  let x5 := Abs (Sub (Var "cy") (Var "ay")) in
  let x6 := Abs (Sub (Var "ay") (Var "oy")) in
  let x7 := Abs (Sub (Var "cx") (Var "ax")) in
  let x8 := Abs (Sub (Var "bx") (Var "ax")) in
  let x9 := Abs (Sub (Var "az") (Var "oz")) in
  Add (Mul (Num 3 (-51)) (Add (Add (Mul x1 (Add (Mul x2 x3) (Mul x4 x5))) (Mul x6 (Add (Mul x4 x7)
    (Mul x8 x3)))) (Mul x9 (Add (Mul x8 x5) (Mul x2 x7))))) (Mul (Num 1 (-1060)) (Add (Add (Add
    (Num 1 0) x1) x6) x9)).

(** bounds.FromPoint.fractions: D *)
Definition from_point_D : expr :=
  let x1 := Sub (Var "by") (Var "ay") in
  let x2 := Sub (Var "cz") (Var "az") in
  let x3 := Sub (Var "bz") (Var "az") in
  let x4 := Sub (Var "cy") (Var "ay") in
  let x5 := Sub (Var "cx") (Var "ax") in
  let x6 := Sub (Var "bx") (Var "ax") in
  Add (Add (Mul (Var "dx") (Sub (Mul x1 x2) (Mul x3 x4))) (Mul (Var "dy") (Sub (Mul x3 x5) (Mul x6
    x2)))) (Mul (Var "dz") (Sub (Mul x6 x4) (Mul x1 x5))).

(** bounds.FromPoint.fractions: D error *)
Definition from_point_D_error : expr :=
  let x1 := Abs (Sub (Var "by") (Var "ay")) in
  let x2 := Abs (Sub (Var "cz") (Var "az")) in
  let x3 := Abs (Sub (Var "bz") (Var "az")) in
  let x4 := Abs (Sub (Var "cy") (Var "ay")) in
  let x5 := Abs (Sub (Var "cx") (Var "ax")) in
  let x6 := Abs (Sub (Var "bx") (Var "ax")) in
  Add (Mul (Num 3 (-51)) (Add (Add (Mul (Var "rx") (Add (Mul x1 x2) (Mul x3 x4))) (Mul (Var "ry")
    (Add (Mul x3 x5) (Mul x6 x2)))) (Mul (Var "rz") (Add (Mul x6 x4) (Mul x1 x5))))) (Mul
    (Num 1 (-1060)) (Add (Add (Add (Num 1 0) (Var "rx")) (Var "ry")) (Var "rz"))).

(** bounds.Parallel.edges: ab *)
Definition parallel_ab : expr :=
  let x1 := Sub (Var "by") (Var "ay") in
  let x2 := Sub (Var "bz") (Var "az") in
  let x3 := Sub (Var "bx") (Var "ax") in
  Add (Add (Mul (Sub (Var "ax") (Var "ox")) (Sub (Mul x1 (Var "dz")) (Mul x2 (Var "dy")))) (Mul (Sub
    (Var "ay") (Var "oy")) (Sub (Mul x2 (Var "dx")) (Mul x3 (Var "dz"))))) (Mul (Sub (Var "az")
    (Var "oz")) (Sub (Mul x3 (Var "dy")) (Mul x1 (Var "dx")))).

(** bounds.Parallel.edges: bc *)
Definition parallel_bc : expr :=
  let x1 := Sub (Var "cy") (Var "by") in
  let x2 := Sub (Var "cz") (Var "bz") in
  let x3 := Sub (Var "cx") (Var "bx") in
  Add (Add (Mul (Sub (Var "bx") (Var "ox")) (Sub (Mul x1 (Var "dz")) (Mul x2 (Var "dy")))) (Mul (Sub
    (Var "by") (Var "oy")) (Sub (Mul x2 (Var "dx")) (Mul x3 (Var "dz"))))) (Mul (Sub (Var "bz")
    (Var "oz")) (Sub (Mul x3 (Var "dy")) (Mul x1 (Var "dx")))).

(** bounds.Parallel.edges: ca *)
Definition parallel_ca : expr :=
  let x1 := Sub (Var "ay") (Var "cy") in
  let x2 := Sub (Var "az") (Var "cz") in
  let x3 := Sub (Var "ax") (Var "cx") in
  Add (Add (Mul (Sub (Var "cx") (Var "ox")) (Sub (Mul x1 (Var "dz")) (Mul x2 (Var "dy")))) (Mul (Sub
    (Var "cy") (Var "oy")) (Sub (Mul x2 (Var "dx")) (Mul x3 (Var "dz"))))) (Mul (Sub (Var "cz")
    (Var "oz")) (Sub (Mul x3 (Var "dy")) (Mul x1 (Var "dx")))).

(** bounds.Parallel.edges: error *)
Definition parallel_error : expr :=
  let x1 := Max (Abs (Sub (Var "ax") (Var "lx"))) (Abs (Sub (Var "ax") (Var "hx"))) in
  let x2 := Abs (Sub (Var "by") (Var "ay")) in
  let x3 := Abs (Var "dz") in
  let x4 := Abs (Sub (Var "bz") (Var "az")) in
  let x5 := Abs (Var "dy") in
  let x6 := Max (Abs (Sub (Var "ay") (Var "ly"))) (Abs (Sub (Var "ay") (Var "hy"))) in
  let x7 := Abs (Var "dx") in
  let x8 := Abs (Sub (Var "bx") (Var "ax")) in
  let x9 := Max (Abs (Sub (Var "az") (Var "lz"))) (Abs (Sub (Var "az") (Var "hz"))) in
  let x10 := Max (Abs (Sub (Var "bx") (Var "lx"))) (Abs (Sub (Var "bx") (Var "hx"))) in
  let x11 := Abs (Sub (Var "cy") (Var "by")) in
  let x12 := Abs (Sub (Var "cz") (Var "bz")) in
  let x13 := Max (Abs (Sub (Var "by") (Var "ly"))) (Abs (Sub (Var "by") (Var "hy"))) in
  let x14 := Abs (Sub (Var "cx") (Var "bx")) in
  let x15 := Max (Abs (Sub (Var "bz") (Var "lz"))) (Abs (Sub (Var "bz") (Var "hz"))) in
  let x16 := Max (Abs (Sub (Var "cx") (Var "lx"))) (Abs (Sub (Var "cx") (Var "hx"))) in
  let x17 := Abs (Sub (Var "ay") (Var "cy")) in
  let x18 := Abs (Sub (Var "az") (Var "cz")) in
  let x19 := Max (Abs (Sub (Var "cy") (Var "ly"))) (Abs (Sub (Var "cy") (Var "hy"))) in
  let x20 := Abs (Sub (Var "ax") (Var "cx")) in
  let x21 := Max (Abs (Sub (Var "cz") (Var "lz"))) (Abs (Sub (Var "cz") (Var "hz"))) in
  Max (Max (Add (Mul (Num 3 (-51)) (Add (Add (Mul x1 (Add (Mul x2 x3) (Mul x4 x5))) (Mul x6 (Add
    (Mul x4 x7) (Mul x8 x3)))) (Mul x9 (Add (Mul x8 x5) (Mul x2 x7))))) (Mul (Num 1 (-1060)) (Add
    (Add (Add (Num 1 0) x1) x6) x9))) (Add (Mul (Num 3 (-51)) (Add (Add (Mul x10 (Add (Mul x11 x3)
    (Mul x12 x5))) (Mul x13 (Add (Mul x12 x7) (Mul x14 x3)))) (Mul x15 (Add (Mul x14 x5) (Mul x11
    x7))))) (Mul (Num 1 (-1060)) (Add (Add (Add (Num 1 0) x10) x13) x15)))) (Add (Mul (Num 3 (-51))
    (Add (Add (Mul x16 (Add (Mul x17 x3) (Mul x18 x5))) (Mul x19 (Add (Mul x18 x7) (Mul x20 x3))))
    (Mul x21 (Add (Mul x20 x5) (Mul x17 x7))))) (Mul (Num 1 (-1060)) (Add (Add (Add (Num 1 0) x16)
    x19) x21))).

(** bounds.Parallel.fractions: T *)
Definition parallel_T : expr :=
  let x1 := Sub (Var "by") (Var "ay") in
  let x2 := Sub (Var "cz") (Var "az") in
  let x3 := Sub (Var "bz") (Var "az") in
  let x4 := Sub (Var "cy") (Var "ay") in
  let x5 := Sub (Var "cx") (Var "ax") in
  let x6 := Sub (Var "bx") (Var "ax") in
  Add (Add (Mul (Sub (Var "ax") (Var "ox")) (Sub (Mul x1 x2) (Mul x3 x4))) (Mul (Sub (Var "ay")
    (Var "oy")) (Sub (Mul x3 x5) (Mul x6 x2)))) (Mul (Sub (Var "az") (Var "oz")) (Sub (Mul x6 x4)
    (Mul x1 x5))).

(** bounds.Parallel.fractions: T error *)
Definition parallel_T_error : expr :=
  let x1 := Max (Abs (Sub (Var "ax") (Var "lx"))) (Abs (Sub (Var "ax") (Var "hx"))) in
  let x2 := Abs (Sub (Var "by") (Var "ay")) in
  let x3 := Abs (Sub (Var "cz") (Var "az")) in
  let x4 := Abs (Sub (Var "bz") (Var "az")) in
  let x5 := Abs (Sub (Var "cy") (Var "ay")) in
  let x6 := Max (Abs (Sub (Var "ay") (Var "ly"))) (Abs (Sub (Var "ay") (Var "hy"))) in
  let x7 := Abs (Sub (Var "cx") (Var "ax")) in
  let x8 := Abs (Sub (Var "bx") (Var "ax")) in
  let x9 := Max (Abs (Sub (Var "az") (Var "lz"))) (Abs (Sub (Var "az") (Var "hz"))) in
  Add (Mul (Num 3 (-51)) (Add (Add (Mul x1 (Add (Mul x2 x3) (Mul x4 x5))) (Mul x6 (Add (Mul x4 x7)
    (Mul x8 x3)))) (Mul x9 (Add (Mul x8 x5) (Mul x2 x7))))) (Mul (Num 1 (-1060)) (Add (Add (Add
    (Num 1 0) x1) x6) x9)).

(** bounds.Parallel.fractions: D *)
Definition parallel_D : expr :=
  let x1 := Sub (Var "by") (Var "ay") in
  let x2 := Sub (Var "cz") (Var "az") in
  let x3 := Sub (Var "bz") (Var "az") in
  let x4 := Sub (Var "cy") (Var "ay") in
  let x5 := Sub (Var "cx") (Var "ax") in
  let x6 := Sub (Var "bx") (Var "ax") in
  Add (Add (Mul (Var "dx") (Sub (Mul x1 x2) (Mul x3 x4))) (Mul (Var "dy") (Sub (Mul x3 x5) (Mul x6
    x2)))) (Mul (Var "dz") (Sub (Mul x6 x4) (Mul x1 x5))).

(** bounds.Parallel.fractions: D error *)
Definition parallel_D_error : expr :=
  let x1 := Abs (Var "dx") in
  let x2 := Abs (Sub (Var "by") (Var "ay")) in
  let x3 := Abs (Sub (Var "cz") (Var "az")) in
  let x4 := Abs (Sub (Var "bz") (Var "az")) in
  let x5 := Abs (Sub (Var "cy") (Var "ay")) in
  let x6 := Abs (Var "dy") in
  let x7 := Abs (Sub (Var "cx") (Var "ax")) in
  let x8 := Abs (Sub (Var "bx") (Var "ax")) in
  let x9 := Abs (Var "dz") in
  Add (Mul (Num 3 (-51)) (Add (Add (Mul x1 (Add (Mul x2 x3) (Mul x4 x5))) (Mul x6 (Add (Mul x4 x7)
    (Mul x8 x3)))) (Mul x9 (Add (Mul x8 x5) (Mul x2 x7))))) (Mul (Num 1 (-1060)) (Add (Add (Add
    (Num 1 0) x1) x6) x9)).

(** bounds.plane_fractions: T *)
Definition plane_T : expr :=
  Add (Add (Mul (Sub (Var "px") (Var "ox")) (Var "nx")) (Mul (Sub (Var "py") (Var "oy"))
    (Var "ny"))) (Mul (Sub (Var "pz") (Var "oz")) (Var "nz")).

(** bounds.plane_fractions: T error *)
Definition plane_T_error : expr :=
  let x1 := Abs (Sub (Var "px") (Var "ox")) in
  let x2 := Abs (Sub (Var "py") (Var "oy")) in
  let x3 := Abs (Sub (Var "pz") (Var "oz")) in
  Add (Mul (Num 3 (-51)) (Add (Add (Mul x1 (Abs (Var "nx"))) (Mul x2 (Abs (Var "ny")))) (Mul x3 (Abs
    (Var "nz"))))) (Mul (Num 1 (-1060)) (Add (Add (Add (Num 1 0) x1) x2) x3)).

(** bounds.plane_fractions: D *)
Definition plane_D : expr :=
  Add (Add (Mul (Var "dx") (Var "nx")) (Mul (Var "dy") (Var "ny"))) (Mul (Var "dz") (Var "nz")).

(** bounds.plane_fractions: D error *)
Definition plane_D_error : expr :=
  let x1 := Abs (Var "dx") in
  let x2 := Abs (Var "dy") in
  let x3 := Abs (Var "dz") in
  Add (Mul (Num 3 (-51)) (Add (Add (Mul x1 (Abs (Var "nx"))) (Mul x2 (Abs (Var "ny")))) (Mul x3 (Abs
    (Var "nz"))))) (Mul (Num 1 (-1060)) (Add (Add (Add (Num 1 0) x1) x2) x3)).

(** bounds.Fractions.interval: low *)
Definition interval_low : expr :=
  let x1 := Abs (Var "D") in
  let x2 := Div (Var "T") (Var "D") in
  let x3 := Abs x2 in
  let x4 := Add (Mul (Add (Div (Add (Mul x3 (Var "ED")) (Var "ET")) (Sub x1 (Var "ED"))) (Mul
    (Num 1 (-53)) x3)) (Num 281474976710657 (-48))) (Num 1 (-1060)) in
  let x5 := Div (Sub (Abs (Var "T")) (Var "ET")) (Add x1 (Var "ED")) in
  Where (And (Less (Var "ED") x1) (Finite x4)) (Prev (Sub x2 x4)) (Where (Less (Num 0 0) x5) (Sub
    (Mul x5 (Num 281474976710655 (-48))) (Num 1 (-1060))) (Num 0 0)).

(** bounds.Fractions.interval: high *)
Definition interval_high : expr :=
  let x1 := Abs (Var "D") in
  let x2 := Div (Var "T") (Var "D") in
  let x3 := Abs x2 in
  let x4 := Add (Mul (Add (Div (Add (Mul x3 (Var "ED")) (Var "ET")) (Sub x1 (Var "ED"))) (Mul
    (Num 1 (-53)) x3)) (Num 281474976710657 (-48))) (Num 1 (-1060)) in
  Where (And (Less (Var "ED") x1) (Finite x4)) (Next (Add x2 x4)) Inf.

(** contest.sides: possible *)
Definition sides_possible : test :=
  Not (And (Less (Min (Min (Var "e1") (Var "e2")) (Var "e3")) (Neg (Var "error"))) (Less
    (Var "error") (Max (Max (Var "e1") (Var "e2")) (Var "e3")))).

(** contest.sides: sure *)
Definition sides_sure : test :=
  Or (Less (Var "error") (Min (Min (Var "e1") (Var "e2")) (Var "e3"))) (Less (Max (Max (Var "e1")
    (Var "e2")) (Var "e3")) (Neg (Var "error"))).

(** contest.in_range, start not negative: low *)
Definition in_range_low : expr :=
  Var "low".

(** contest.in_range, start not negative: high *)
Definition in_range_high : expr :=
  Var "high".

(** contest.in_range, start not negative: outside *)
Definition in_range_outside : test :=
  Or (Less (Var "high") (Var "start")) (Less (Var "end") (Var "low")).

(** contest.in_range, start not negative: doubt *)
Definition in_range_doubt : expr :=
  Where (And (Given "sure") (Finite (Var "high"))) (Where (And (Less (Var "start") (Var "low"))
    (Less (Var "high") (Var "end"))) (Num 0 0) (Num 1 1)) (Num 1 0).

(** contest.in_range, start not negative: path *)
Definition in_range_path : test :=
  Not (Less (Var "start") (Num 0 0)).

(** contest.in_range, start negative: low *)
Definition in_range_behind_low : expr :=
  Where (Finite (Var "high")) (Var "low") (Neg Inf).

(** contest.in_range, start negative: high *)
Definition in_range_behind_high : expr :=
  Var "high".

(** contest.in_range, start negative: outside *)
Definition in_range_behind_outside : test :=
  And (Or (Less (Var "high") (Var "start")) (Less (Var "end") (Var "low"))) (Finite (Var "high")).

(** contest.in_range, start negative: doubt *)
Definition in_range_behind_doubt : expr :=
  Where (And (Given "sure") (Finite (Var "high"))) (Where (And (Less (Var "start") (Var "low"))
    (Less (Var "high") (Var "end"))) (Num 0 0) (Num 1 1)) (Num 1 0).

(** contest.in_range, start negative: path *)
Definition in_range_behind_path : test :=
  Less (Var "start") (Num 0 0).

(** order.order_of, rays from one point *)
Definition order_from_point : expr :=
  let x1 := Abs (Var "dx") in
  let x2 := Abs (Var "dy") in
  let x3 := Abs (Var "dz") in
  let x4 := Add (Var "base") (Add (Add (Mul (Var "dx") (Var "v1")) (Mul (Var "dy") (Var "v2"))) (Mul
    (Var "dz") (Var "v3"))) in
  Where (Not (Or (Or (Or (Or (Not (Same (Var "base") (Num 0 0))) (Not (Same (Var "v1") (Num 0 0))))
    (Not (Same (Var "v2") (Num 0 0)))) (Not (Same (Var "v3") (Num 0 0)))) (Not (Same (Var "sign")
    (Num 0 0))))) (Num 0 0) (Where (Less (Add (Mul (Num 3 (-51)) (Add (Abs (Var "base")) (Add (Add
    (Mul x1 (Abs (Var "v1"))) (Mul x2 (Abs (Var "v2")))) (Mul x3 (Abs (Var "v3")))))) (Mul
    (Num 1 (-1060)) (Add (Add (Add (Num 1 0) x1) x2) x3))) (Abs x4)) (Mul (Where (Less (Num 0 0) x4)
    (Num 1 0) (Where (Less x4 (Num 0 0)) (Num (-1) 0) (Num 0 0))) (Var "sign")) (Num 1 1)).

(** order.order_of, rays from one point: value *)
Definition order_from_point_value : expr :=
  Add (Var "base") (Add (Add (Mul (Var "dx") (Var "v1")) (Mul (Var "dy") (Var "v2"))) (Mul
    (Var "dz") (Var "v3"))).

(** order.order_of, rays from one point: error *)
Definition order_from_point_error : expr :=
  let x1 := Abs (Var "dx") in
  let x2 := Abs (Var "dy") in
  let x3 := Abs (Var "dz") in
  Add (Mul (Num 3 (-51)) (Add (Abs (Var "base")) (Add (Add (Mul x1 (Abs (Var "v1"))) (Mul x2 (Abs
    (Var "v2")))) (Mul x3 (Abs (Var "v3")))))) (Mul (Num 1 (-1060)) (Add (Add (Add (Num 1 0) x1) x2)
    x3)).

(** order.order_of, rays from one point: known *)
Definition order_from_point_known : test :=
  let x1 := Abs (Var "dx") in
  let x2 := Abs (Var "dy") in
  let x3 := Abs (Var "dz") in
  Less (Add (Mul (Num 3 (-51)) (Add (Abs (Var "base")) (Add (Add (Mul x1 (Abs (Var "v1"))) (Mul x2
    (Abs (Var "v2")))) (Mul x3 (Abs (Var "v3")))))) (Mul (Num 1 (-1060)) (Add (Add (Add (Num 1 0)
    x1) x2) x3))) (Abs (Add (Var "base") (Add (Add (Mul (Var "dx") (Var "v1")) (Mul (Var "dy")
    (Var "v2"))) (Mul (Var "dz") (Var "v3"))))).

(** order.order_of, parallel rays *)
Definition order_parallel : expr :=
  let x1 := Sub (Var "ox") (Var "o0x") in
  let x2 := Abs x1 in
  let x3 := Sub (Var "oy") (Var "o0y") in
  let x4 := Abs x3 in
  let x5 := Sub (Var "oz") (Var "o0z") in
  let x6 := Abs x5 in
  let x7 := Add (Var "base") (Add (Add (Mul x1 (Var "v1")) (Mul x3 (Var "v2"))) (Mul x5 (Var "v3")))
    in
  Where (Not (Or (Or (Or (Or (Not (Same (Var "base") (Num 0 0))) (Not (Same (Var "v1") (Num 0 0))))
    (Not (Same (Var "v2") (Num 0 0)))) (Not (Same (Var "v3") (Num 0 0)))) (Not (Same (Var "sign")
    (Num 0 0))))) (Num 0 0) (Where (Less (Add (Mul (Num 3 (-51)) (Add (Abs (Var "base")) (Add (Add
    (Mul x2 (Abs (Var "v1"))) (Mul x4 (Abs (Var "v2")))) (Mul x6 (Abs (Var "v3")))))) (Mul
    (Num 1 (-1060)) (Add (Add (Add (Num 1 0) x2) x4) x6))) (Abs x7)) (Mul (Where (Less (Num 0 0) x7)
    (Num 1 0) (Where (Less x7 (Num 0 0)) (Num (-1) 0) (Num 0 0))) (Var "sign")) (Num 1 1)).

(** order.order_of, parallel rays: value *)
Definition order_parallel_value : expr :=
  Add (Var "base") (Add (Add (Mul (Sub (Var "ox") (Var "o0x")) (Var "v1")) (Mul (Sub (Var "oy")
    (Var "o0y")) (Var "v2"))) (Mul (Sub (Var "oz") (Var "o0z")) (Var "v3"))).

(** order.order_of, parallel rays: error *)
Definition order_parallel_error : expr :=
  let x1 := Abs (Sub (Var "ox") (Var "o0x")) in
  let x2 := Abs (Sub (Var "oy") (Var "o0y")) in
  let x3 := Abs (Sub (Var "oz") (Var "o0z")) in
  Add (Mul (Num 3 (-51)) (Add (Abs (Var "base")) (Add (Add (Mul x1 (Abs (Var "v1"))) (Mul x2 (Abs
    (Var "v2")))) (Mul x3 (Abs (Var "v3")))))) (Mul (Num 1 (-1060)) (Add (Add (Add (Num 1 0) x1) x2)
    x3)).

(** order.order_of, parallel rays: known *)
Definition order_parallel_known : test :=
  let x1 := Sub (Var "ox") (Var "o0x") in
  let x2 := Abs x1 in
  let x3 := Sub (Var "oy") (Var "o0y") in
  let x4 := Abs x3 in
  let x5 := Sub (Var "oz") (Var "o0z") in
  let x6 := Abs x5 in
  Less (Add (Mul (Num 3 (-51)) (Add (Abs (Var "base")) (Add (Add (Mul x2 (Abs (Var "v1"))) (Mul x4
    (Abs (Var "v2")))) (Mul x6 (Abs (Var "v3")))))) (Mul (Num 1 (-1060)) (Add (Add (Add (Num 1 0)
    x2) x4) x6))) (Abs (Add (Var "base") (Add (Add (Mul x1 (Var "v1")) (Mul x3 (Var "v2"))) (Mul x5
    (Var "v3"))))).

(** edge_functions.set_up, perspective: bc 1 *)
Definition set_up_perspective_bc_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x5 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x6 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  Mul x7 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x5 (Var "wc"))
    (Mul (Var "wb") x4))) (Mul (Sub (Var "qa") (Mul x3 (Var "wa"))) (Sub (Mul (Var "wb") x6) (Mul x2
    (Var "wc"))))) (Mul (Var "wa") x7)) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective: bc y *)
Definition set_up_perspective_bc_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Mul (Var "wb") x2) (Mul x3 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x7 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  Mul x4 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x6 (Var "wc"))
    (Mul (Var "wb") x7))) (Mul (Sub (Var "qa") (Mul x5 (Var "wa"))) x4)) (Mul (Var "wa") (Sub (Mul
    x3 x7) (Mul x6 x2)))) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective: bc x *)
Definition set_up_perspective_bc_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x3 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x4 := Sub (Mul x2 (Var "wc")) (Mul (Var "wb") x3) in
  let x5 := Add (Var "x0") (Num 1 (-1)) in
  let x6 := Sub (Var "pc") (Mul x5 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x5 (Var "wb")) in
  Mul x4 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x5 (Var "wa"))) x4) (Mul (Sub (Var "qa")
    (Mul x1 (Var "wa"))) (Sub (Mul (Var "wb") x6) (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul
    x7 x3) (Mul x2 x6)))) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective: ca 1 *)
Definition set_up_perspective_ca_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qa") (Mul x3 (Var "wa")) in
  let x5 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x6 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x8 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  Mul (Sub (Mul x2 x4) (Mul x5 x6)) (Where (Less (Add (Add (Mul x6 (Sub (Mul x7 (Var "wc")) (Mul
    (Var "wb") x5))) (Mul x4 (Sub (Mul (Var "wb") x2) (Mul x8 (Var "wc"))))) (Mul (Var "wa") (Sub
    (Mul x8 x5) (Mul x7 x2)))) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective: ca y *)
Definition set_up_perspective_ca_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x4 := Add (Var "y0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x4 (Var "wb")) in
  let x6 := Sub (Var "qc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  Mul (Sub (Mul (Var "wc") x2) (Mul x3 (Var "wa"))) (Where (Less (Add (Add (Mul x2 (Sub (Mul x5
    (Var "wc")) (Mul (Var "wb") x6))) (Mul (Sub (Var "qa") (Mul x4 (Var "wa"))) (Sub (Mul (Var "wb")
    x3) (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x7 x6) (Mul x5 x3)))) (Num 0 0))
    (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective: ca x *)
Definition set_up_perspective_ca_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x3 := Sub (Var "qa") (Mul x1 (Var "wa")) in
  let x4 := Add (Var "x0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x6 := Sub (Var "pc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x4 (Var "wb")) in
  Mul (Sub (Mul x2 (Var "wa")) (Mul (Var "wc") x3)) (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul
    x4 (Var "wa"))) (Sub (Mul x5 (Var "wc")) (Mul (Var "wb") x2))) (Mul x3 (Sub (Mul (Var "wb") x6)
    (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x7 x2) (Mul x5 x6)))) (Num 0 0)) (Num (-1) 0)
    (Num 1 0)).

(** edge_functions.set_up, perspective: ab 1 *)
Definition set_up_perspective_ab_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x5 := Sub (Var "qa") (Mul x3 (Var "wa")) in
  let x6 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x7 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x8 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  Mul (Sub (Mul x2 x4) (Mul x5 x6)) (Where (Less (Add (Add (Mul x2 (Sub (Mul x4 (Var "wc")) (Mul
    (Var "wb") x7))) (Mul x5 (Sub (Mul (Var "wb") x8) (Mul x6 (Var "wc"))))) (Mul (Var "wa") (Sub
    (Mul x6 x7) (Mul x4 x8)))) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective: ab y *)
Definition set_up_perspective_ab_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x3 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x4 := Add (Var "y0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x4 (Var "wb")) in
  let x6 := Sub (Var "qc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  Mul (Sub (Mul (Var "wa") x2) (Mul x3 (Var "wb"))) (Where (Less (Add (Add (Mul x3 (Sub (Mul x5
    (Var "wc")) (Mul (Var "wb") x6))) (Mul (Sub (Var "qa") (Mul x4 (Var "wa"))) (Sub (Mul (Var "wb")
    x7) (Mul x2 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x2 x6) (Mul x5 x7)))) (Num 0 0))
    (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective: ab x *)
Definition set_up_perspective_ab_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x4 := Add (Var "x0") (Num 1 (-1)) in
  let x5 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x6 := Sub (Var "pc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x4 (Var "wb")) in
  Mul (Sub (Mul x2 (Var "wb")) (Mul (Var "wa") x3)) (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul
    x4 (Var "wa"))) (Sub (Mul x3 (Var "wc")) (Mul (Var "wb") x5))) (Mul x2 (Sub (Mul (Var "wb") x6)
    (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x7 x5) (Mul x3 x6)))) (Num 0 0)) (Num (-1) 0)
    (Num 1 0)).

(** edge_functions.set_up, perspective: nearness 1 *)
Definition set_up_perspective_nearness_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x5 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x6 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x9 := Sub (Var "qa") (Mul x3 (Var "wa")) in
  let x10 := Add (Add (Mul x8 (Sub (Mul x5 (Var "wc")) (Mul (Var "wb") x4))) (Mul x9 (Sub (Mul
    (Var "wb") x6) (Mul x2 (Var "wc"))))) (Mul (Var "wa") x7) in
  let x11 := Where (Less x10 (Num 0 0)) (Num (-1) 0) (Num 1 0) in
  Div (Add (Add (Mul x7 x11) (Mul (Sub (Mul x6 x9) (Mul x4 x8)) x11)) (Mul (Sub (Mul x8 x5) (Mul x9
    x2)) x11)) (Abs x10).

(** edge_functions.set_up, perspective: nearness y *)
Definition set_up_perspective_nearness_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Mul (Var "wb") x2) (Mul x3 (Var "wc")) in
  let x5 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x6 := Add (Var "y0") (Num 1 (-1)) in
  let x7 := Sub (Var "qb") (Mul x6 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x6 (Var "wc")) in
  let x9 := Add (Add (Mul x5 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul (Sub (Var "qa")
    (Mul x6 (Var "wa"))) x4)) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x2))) in
  let x10 := Where (Less x9 (Num 0 0)) (Num (-1) 0) (Num 1 0) in
  Div (Add (Add (Mul x4 x10) (Mul (Sub (Mul (Var "wc") x5) (Mul x2 (Var "wa"))) x10)) (Mul (Sub (Mul
    (Var "wa") x3) (Mul x5 (Var "wb"))) x10)) (Abs x9).

(** edge_functions.set_up, perspective: nearness x *)
Definition set_up_perspective_nearness_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x3 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x4 := Sub (Mul x2 (Var "wc")) (Mul (Var "wb") x3) in
  let x5 := Add (Var "x0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x1 (Var "wa")) in
  let x7 := Sub (Var "pc") (Mul x5 (Var "wc")) in
  let x8 := Sub (Var "pb") (Mul x5 (Var "wb")) in
  let x9 := Add (Add (Mul (Sub (Var "pa") (Mul x5 (Var "wa"))) x4) (Mul x6 (Sub (Mul (Var "wb") x7)
    (Mul x8 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x8 x3) (Mul x2 x7))) in
  let x10 := Where (Less x9 (Num 0 0)) (Num (-1) 0) (Num 1 0) in
  Div (Add (Add (Mul x4 x10) (Mul (Sub (Mul x3 (Var "wa")) (Mul (Var "wc") x6)) x10)) (Mul (Sub (Mul
    x6 (Var "wb")) (Mul (Var "wa") x2)) x10)) (Abs x9).

(** edge_functions.set_up, perspective: edge error *)
Definition set_up_perspective_edge_error : expr :=
  let x1 := Mul (Num 1 2) (Var "reach") in
  let x2 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x3 := Add (Var "c0") (Mul (Var "c1") x2) in
  let x4 := Mul (Var "weight") x2 in
  let x5 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x4 in
  let x6 := Add (Var "x0") (Num 1 (-1)) in
  let x7 := Add (Var "y0") (Num 1 (-1)) in
  let x8 := Add (Max (Max (Max (Max (Max (Abs (Sub (Var "pa") (Mul x6 (Var "wa")))) (Abs (Sub
    (Var "pb") (Mul x6 (Var "wb"))))) (Abs (Sub (Var "pc") (Mul x6 (Var "wc"))))) (Abs (Sub
    (Var "qa") (Mul x7 (Var "wa"))))) (Abs (Sub (Var "qb") (Mul x7 (Var "wb"))))) (Abs (Sub
    (Var "qc") (Mul x7 (Var "wc"))))) x3 in
  Add (Mul (Num 4548635623644201 (-52)) (Add (Add (Mul x1 (Add (Mul x3 x5) (Mul x8 x4))) (Mul (Mul
    (Num 1 2) x8) x3)) (Mul (Num 1 (-50)) (Mul x8 (Add (Mul x1 x5) (Mul (Num 1 1) x8))))))
    (Num 1 (-1000)).

(** edge_functions.set_up, perspective: sure *)
Definition set_up_perspective_sure : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  And (Less (Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x11) (Add (Mul (Mul
    (Num 1 1) x10) x13) (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52)) x11) x11) x13)))
    (Num 1 (-1000))) x14) (Finite x14).

(** edge_functions.set_up, perspective: nearness error *)
Definition set_up_perspective_nearness_error : expr :=
  let x1 := Mul (Num 1 2) (Var "reach") in
  let x2 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x3 := Add (Var "c0") (Mul (Var "c1") x2) in
  let x4 := Mul (Var "weight") x2 in
  let x5 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x4 in
  let x6 := Add (Var "x0") (Num 1 (-1)) in
  let x7 := Sub (Var "pa") (Mul x6 (Var "wa")) in
  let x8 := Sub (Var "pb") (Mul x6 (Var "wb")) in
  let x9 := Sub (Var "pc") (Mul x6 (Var "wc")) in
  let x10 := Add (Var "y0") (Num 1 (-1)) in
  let x11 := Sub (Var "qa") (Mul x10 (Var "wa")) in
  let x12 := Sub (Var "qb") (Mul x10 (Var "wb")) in
  let x13 := Sub (Var "qc") (Mul x10 (Var "wc")) in
  let x14 := Add (Max (Max (Max (Max (Max (Abs x7) (Abs x8)) (Abs x9)) (Abs x11)) (Abs x12)) (Abs
    x13)) x3 in
  let x15 := Mul x14 x4 in
  let x16 := Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x14) (Add (Mul (Mul
    (Num 1 1) x3) x5) x15)) (Mul (Mul (Mul (Num 25 (-52)) x14) x14) x5))) (Num 1 (-1000)) in
  let x17 := Sub (Abs (Add (Add (Mul x7 (Sub (Mul x12 (Var "wc")) (Mul (Var "wb") x13))) (Mul x11
    (Sub (Mul (Var "wb") x9) (Mul x8 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x8 x13) (Mul x12
    x9))))) x16 in
  Mul (Add (Div (Mul (Num 3 1) (Add (Mul (Num 4548635623644201 (-52)) (Add (Add (Mul x1 (Add (Mul x3
    x5) x15)) (Mul (Mul (Num 1 2) x14) x3)) (Mul (Num 1 (-50)) (Mul x14 (Add (Mul x1 x5) (Mul
    (Num 1 1) x14)))))) (Num 1 (-1000)))) x17) (Mul (Add (Div x16 x17) (Add (Mul (Num 1 1)
    (Var "ray_error")) (Num 1 (-49)))) (Var "nearest"))) (Num 4548635623644201 (-52)).

(** edge_functions.set_up, perspective: T *)
Definition set_up_perspective_T : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Add (Var "y0") (Num 1 (-1)) in
  let x3 := Sub (Var "qb") (Mul x2 (Var "wb")) in
  let x4 := Sub (Var "qc") (Mul x2 (Var "wc")) in
  let x5 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x6 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x3 (Var "wc")) (Mul (Var "wb") x4)))
    (Mul (Sub (Var "qa") (Mul x2 (Var "wa"))) (Sub (Mul (Var "wb") x5) (Mul x6 (Var "wc"))))) (Mul
    (Var "wa") (Sub (Mul x6 x4) (Mul x3 x5))).

(** edge_functions.set_up, perspective: T error *)
Definition set_up_perspective_T_error : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Add (Var "y0") (Num 1 (-1)) in
  let x3 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x4 := Add (Var "c0") (Mul (Var "c1") x3) in
  let x5 := Add (Max (Max (Max (Max (Max (Abs (Sub (Var "pa") (Mul x1 (Var "wa")))) (Abs (Sub
    (Var "pb") (Mul x1 (Var "wb"))))) (Abs (Sub (Var "pc") (Mul x1 (Var "wc"))))) (Abs (Sub
    (Var "qa") (Mul x2 (Var "wa"))))) (Abs (Sub (Var "qb") (Mul x2 (Var "wb"))))) (Abs (Sub
    (Var "qc") (Mul x2 (Var "wc"))))) x4 in
  let x6 := Mul (Var "weight") x3 in
  let x7 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x6 in
  Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x5) (Add (Mul (Mul (Num 1 1) x4)
    x7) (Mul x5 x6))) (Mul (Mul (Mul (Num 25 (-52)) x5) x5) x7))) (Num 1 (-1000)).

(** edge_functions.set_up, perspective: path *)
Definition set_up_perspective_path : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  And (Not (Not (Less (Mul x11 (Add (Mul (Mul (Num 1 2) (Var "reach")) x13) (Mul (Num 1 1) x11)))
    (Num 1 1000)))) (Not (Not (And (Less (Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul
    (Num 3 1) x11) (Add (Mul (Mul (Num 1 1) x10) x13) (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52))
    x11) x11) x13))) (Num 1 (-1000))) x14) (Finite x14)))).

(** edge_functions.set_up, parallel rays: bc 1 *)
Definition set_up_parallel_bc_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x5 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x6 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  Mul x7 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x5 (Var "wc"))
    (Mul (Var "wb") x4))) (Mul (Sub (Var "qa") (Mul x3 (Var "wa"))) (Sub (Mul (Var "wb") x6) (Mul x2
    (Var "wc"))))) (Mul (Var "wa") x7)) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, parallel rays: bc y *)
Definition set_up_parallel_bc_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Mul (Var "wb") x2) (Mul x3 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x7 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  Mul x4 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x6 (Var "wc"))
    (Mul (Var "wb") x7))) (Mul (Sub (Var "qa") (Mul x5 (Var "wa"))) x4)) (Mul (Var "wa") (Sub (Mul
    x3 x7) (Mul x6 x2)))) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, parallel rays: bc x *)
Definition set_up_parallel_bc_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x3 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x4 := Sub (Mul x2 (Var "wc")) (Mul (Var "wb") x3) in
  let x5 := Add (Var "x0") (Num 1 (-1)) in
  let x6 := Sub (Var "pc") (Mul x5 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x5 (Var "wb")) in
  Mul x4 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x5 (Var "wa"))) x4) (Mul (Sub (Var "qa")
    (Mul x1 (Var "wa"))) (Sub (Mul (Var "wb") x6) (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul
    x7 x3) (Mul x2 x6)))) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, parallel rays: ca 1 *)
Definition set_up_parallel_ca_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qa") (Mul x3 (Var "wa")) in
  let x5 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x6 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x8 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  Mul (Sub (Mul x2 x4) (Mul x5 x6)) (Where (Less (Add (Add (Mul x6 (Sub (Mul x7 (Var "wc")) (Mul
    (Var "wb") x5))) (Mul x4 (Sub (Mul (Var "wb") x2) (Mul x8 (Var "wc"))))) (Mul (Var "wa") (Sub
    (Mul x8 x5) (Mul x7 x2)))) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, parallel rays: ca y *)
Definition set_up_parallel_ca_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x4 := Add (Var "y0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x4 (Var "wb")) in
  let x6 := Sub (Var "qc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  Mul (Sub (Mul (Var "wc") x2) (Mul x3 (Var "wa"))) (Where (Less (Add (Add (Mul x2 (Sub (Mul x5
    (Var "wc")) (Mul (Var "wb") x6))) (Mul (Sub (Var "qa") (Mul x4 (Var "wa"))) (Sub (Mul (Var "wb")
    x3) (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x7 x6) (Mul x5 x3)))) (Num 0 0))
    (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, parallel rays: ca x *)
Definition set_up_parallel_ca_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x3 := Sub (Var "qa") (Mul x1 (Var "wa")) in
  let x4 := Add (Var "x0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x6 := Sub (Var "pc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x4 (Var "wb")) in
  Mul (Sub (Mul x2 (Var "wa")) (Mul (Var "wc") x3)) (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul
    x4 (Var "wa"))) (Sub (Mul x5 (Var "wc")) (Mul (Var "wb") x2))) (Mul x3 (Sub (Mul (Var "wb") x6)
    (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x7 x2) (Mul x5 x6)))) (Num 0 0)) (Num (-1) 0)
    (Num 1 0)).

(** edge_functions.set_up, parallel rays: ab 1 *)
Definition set_up_parallel_ab_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x5 := Sub (Var "qa") (Mul x3 (Var "wa")) in
  let x6 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x7 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x8 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  Mul (Sub (Mul x2 x4) (Mul x5 x6)) (Where (Less (Add (Add (Mul x2 (Sub (Mul x4 (Var "wc")) (Mul
    (Var "wb") x7))) (Mul x5 (Sub (Mul (Var "wb") x8) (Mul x6 (Var "wc"))))) (Mul (Var "wa") (Sub
    (Mul x6 x7) (Mul x4 x8)))) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, parallel rays: ab y *)
Definition set_up_parallel_ab_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x3 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x4 := Add (Var "y0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x4 (Var "wb")) in
  let x6 := Sub (Var "qc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  Mul (Sub (Mul (Var "wa") x2) (Mul x3 (Var "wb"))) (Where (Less (Add (Add (Mul x3 (Sub (Mul x5
    (Var "wc")) (Mul (Var "wb") x6))) (Mul (Sub (Var "qa") (Mul x4 (Var "wa"))) (Sub (Mul (Var "wb")
    x7) (Mul x2 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x2 x6) (Mul x5 x7)))) (Num 0 0))
    (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, parallel rays: ab x *)
Definition set_up_parallel_ab_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x4 := Add (Var "x0") (Num 1 (-1)) in
  let x5 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x6 := Sub (Var "pc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x4 (Var "wb")) in
  Mul (Sub (Mul x2 (Var "wb")) (Mul (Var "wa") x3)) (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul
    x4 (Var "wa"))) (Sub (Mul x3 (Var "wc")) (Mul (Var "wb") x5))) (Mul x2 (Sub (Mul (Var "wb") x6)
    (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x7 x5) (Mul x3 x6)))) (Num 0 0)) (Num (-1) 0)
    (Num 1 0)).

(** edge_functions.set_up, parallel rays: nearness 1 *)
Definition set_up_parallel_nearness_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qa") (Mul x3 (Var "wa")) in
  let x5 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x6 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x8 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x9 := Add (Add (Mul x6 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x5))) (Mul x4 (Sub (Mul
    (Var "wb") x2) (Mul x8 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x8 x5) (Mul x7 x2))) in
  let x10 := Where (Less x9 (Num 0 0)) (Num (-1) 0) (Num 1 0) in
  Sub (Div (Add (Mul (Mul (Sub (Mul x2 x4) (Mul x5 x6)) x10) (Sub (Var "tb") (Var "ta"))) (Mul (Mul
    (Sub (Mul x6 x7) (Mul x4 x8)) x10) (Sub (Var "tc") (Var "ta")))) (Neg (Abs x9))) (Var "ta").

(** edge_functions.set_up, parallel rays: nearness y *)
Definition set_up_parallel_nearness_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x4 := Add (Var "y0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x4 (Var "wb")) in
  let x6 := Sub (Var "qc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x8 := Add (Add (Mul x2 (Sub (Mul x5 (Var "wc")) (Mul (Var "wb") x6))) (Mul (Sub (Var "qa")
    (Mul x4 (Var "wa"))) (Sub (Mul (Var "wb") x3) (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul
    x7 x6) (Mul x5 x3))) in
  let x9 := Where (Less x8 (Num 0 0)) (Num (-1) 0) (Num 1 0) in
  Div (Add (Mul (Mul (Sub (Mul (Var "wc") x2) (Mul x3 (Var "wa"))) x9) (Sub (Var "tb") (Var "ta")))
    (Mul (Mul (Sub (Mul (Var "wa") x7) (Mul x2 (Var "wb"))) x9) (Sub (Var "tc") (Var "ta")))) (Neg
    (Abs x8)).

(** edge_functions.set_up, parallel rays: nearness x *)
Definition set_up_parallel_nearness_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x3 := Sub (Var "qa") (Mul x1 (Var "wa")) in
  let x4 := Add (Var "x0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x6 := Sub (Var "pc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x4 (Var "wb")) in
  let x8 := Add (Add (Mul (Sub (Var "pa") (Mul x4 (Var "wa"))) (Sub (Mul x5 (Var "wc")) (Mul
    (Var "wb") x2))) (Mul x3 (Sub (Mul (Var "wb") x6) (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub
    (Mul x7 x2) (Mul x5 x6))) in
  let x9 := Where (Less x8 (Num 0 0)) (Num (-1) 0) (Num 1 0) in
  Div (Add (Mul (Mul (Sub (Mul x2 (Var "wa")) (Mul (Var "wc") x3)) x9) (Sub (Var "tb") (Var "ta")))
    (Mul (Mul (Sub (Mul x3 (Var "wb")) (Mul (Var "wa") x5)) x9) (Sub (Var "tc") (Var "ta")))) (Neg
    (Abs x8)).

(** edge_functions.set_up, parallel rays: edge error *)
Definition set_up_parallel_edge_error : expr :=
  let x1 := Mul (Num 1 2) (Var "reach") in
  let x2 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x3 := Add (Var "c0") (Mul (Var "c1") x2) in
  let x4 := Mul (Var "weight") x2 in
  let x5 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x4 in
  let x6 := Add (Var "x0") (Num 1 (-1)) in
  let x7 := Add (Var "y0") (Num 1 (-1)) in
  let x8 := Add (Max (Max (Max (Max (Max (Abs (Sub (Var "pa") (Mul x6 (Var "wa")))) (Abs (Sub
    (Var "pb") (Mul x6 (Var "wb"))))) (Abs (Sub (Var "pc") (Mul x6 (Var "wc"))))) (Abs (Sub
    (Var "qa") (Mul x7 (Var "wa"))))) (Abs (Sub (Var "qb") (Mul x7 (Var "wb"))))) (Abs (Sub
    (Var "qc") (Mul x7 (Var "wc"))))) x3 in
  Add (Mul (Num 4548635623644201 (-52)) (Add (Add (Mul x1 (Add (Mul x3 x5) (Mul x8 x4))) (Mul (Mul
    (Num 1 2) x8) x3)) (Mul (Num 1 (-50)) (Mul x8 (Add (Mul x1 x5) (Mul (Num 1 1) x8))))))
    (Num 1 (-1000)).

(** edge_functions.set_up, parallel rays: sure *)
Definition set_up_parallel_sure : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  And (Less (Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x11) (Add (Mul (Mul
    (Num 1 1) x10) x13) (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52)) x11) x11) x13)))
    (Num 1 (-1000))) x14) (Finite x14).

(** edge_functions.set_up, parallel rays: nearness error *)
Definition set_up_parallel_nearness_error : expr :=
  let x1 := Mul (Num 1 2) (Var "reach") in
  let x2 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x3 := Add (Var "c0") (Mul (Var "c1") x2) in
  let x4 := Mul (Var "weight") x2 in
  let x5 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x4 in
  let x6 := Add (Var "x0") (Num 1 (-1)) in
  let x7 := Sub (Var "pa") (Mul x6 (Var "wa")) in
  let x8 := Sub (Var "pb") (Mul x6 (Var "wb")) in
  let x9 := Sub (Var "pc") (Mul x6 (Var "wc")) in
  let x10 := Add (Var "y0") (Num 1 (-1)) in
  let x11 := Sub (Var "qa") (Mul x10 (Var "wa")) in
  let x12 := Sub (Var "qb") (Mul x10 (Var "wb")) in
  let x13 := Sub (Var "qc") (Mul x10 (Var "wc")) in
  let x14 := Add (Max (Max (Max (Max (Max (Abs x7) (Abs x8)) (Abs x9)) (Abs x11)) (Abs x12)) (Abs
    x13)) x3 in
  let x15 := Mul x14 x4 in
  let x16 := Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x14) (Add (Mul (Mul
    (Num 1 1) x3) x5) x15)) (Mul (Mul (Mul (Num 25 (-52)) x14) x14) x5))) (Num 1 (-1000)) in
  let x17 := Add (Var "d0") (Mul (Var "d1") x2) in
  Mul (Add (Mul (Div (Mul (Num 3 1) (Add (Add (Mul (Num 4548635623644201 (-52)) (Add (Add (Mul x1
    (Add (Mul x3 x5) x15)) (Mul (Mul (Num 1 2) x14) x3)) (Mul (Num 1 (-50)) (Mul x14 (Add (Mul x1
    x5) (Mul (Num 1 1) x14)))))) (Num 1 (-1000))) x16)) (Sub (Abs (Add (Add (Mul x7 (Sub (Mul x12
    (Var "wc")) (Mul (Var "wb") x13))) (Mul x11 (Sub (Mul (Var "wb") x9) (Mul x8 (Var "wc"))))) (Mul
    (Var "wa") (Sub (Mul x8 x13) (Mul x12 x9))))) x16)) (Add (Max (Abs (Sub (Var "tb") (Var "ta")))
    (Abs (Sub (Var "tc") (Var "ta")))) (Mul (Num 1 1) x17))) (Mul (Num 1 2) x17))
    (Num 4548635623644201 (-52)).

(** edge_functions.set_up, parallel rays: T *)
Definition set_up_parallel_T : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Add (Var "y0") (Num 1 (-1)) in
  let x3 := Sub (Var "qb") (Mul x2 (Var "wb")) in
  let x4 := Sub (Var "qc") (Mul x2 (Var "wc")) in
  let x5 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x6 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x3 (Var "wc")) (Mul (Var "wb") x4)))
    (Mul (Sub (Var "qa") (Mul x2 (Var "wa"))) (Sub (Mul (Var "wb") x5) (Mul x6 (Var "wc"))))) (Mul
    (Var "wa") (Sub (Mul x6 x4) (Mul x3 x5))).

(** edge_functions.set_up, parallel rays: T error *)
Definition set_up_parallel_T_error : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Add (Var "y0") (Num 1 (-1)) in
  let x3 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x4 := Add (Var "c0") (Mul (Var "c1") x3) in
  let x5 := Add (Max (Max (Max (Max (Max (Abs (Sub (Var "pa") (Mul x1 (Var "wa")))) (Abs (Sub
    (Var "pb") (Mul x1 (Var "wb"))))) (Abs (Sub (Var "pc") (Mul x1 (Var "wc"))))) (Abs (Sub
    (Var "qa") (Mul x2 (Var "wa"))))) (Abs (Sub (Var "qb") (Mul x2 (Var "wb"))))) (Abs (Sub
    (Var "qc") (Mul x2 (Var "wc"))))) x4 in
  let x6 := Mul (Var "weight") x3 in
  let x7 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x6 in
  Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x5) (Add (Mul (Mul (Num 1 1) x4)
    x7) (Mul x5 x6))) (Mul (Mul (Mul (Num 25 (-52)) x5) x5) x7))) (Num 1 (-1000)).

(** edge_functions.set_up, parallel rays: path *)
Definition set_up_parallel_path : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  And (Not (Not (Less (Mul (Mul x11 (Add (Mul (Mul (Num 1 2) (Var "reach")) x13) (Mul (Num 1 1)
    x11))) (Max (Max (Max (Max (Max (Abs (Var "ta")) (Abs (Var "tb"))) (Abs (Var "tc"))) (Abs (Sub
    (Var "tb") (Var "ta")))) (Abs (Sub (Var "tc") (Var "ta")))) (Num 1 0))) (Num 1 1000)))) (Not
    (Not (And (Less (Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x11) (Add (Mul
    (Mul (Num 1 1) x10) x13) (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52)) x11) x11) x13)))
    (Num 1 (-1000))) x14) (Finite x14)))).

(** edge_functions.set_up, perspective, where the sign of T is not known: bc 1 *)
Definition set_up_edge_on_bc_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x5 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x6 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  Mul x7 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x5 (Var "wc"))
    (Mul (Var "wb") x4))) (Mul (Sub (Var "qa") (Mul x3 (Var "wa"))) (Sub (Mul (Var "wb") x6) (Mul x2
    (Var "wc"))))) (Mul (Var "wa") x7)) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective, where the sign of T is not known: bc y *)
Definition set_up_edge_on_bc_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Mul (Var "wb") x2) (Mul x3 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x7 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  Mul x4 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x6 (Var "wc"))
    (Mul (Var "wb") x7))) (Mul (Sub (Var "qa") (Mul x5 (Var "wa"))) x4)) (Mul (Var "wa") (Sub (Mul
    x3 x7) (Mul x6 x2)))) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective, where the sign of T is not known: bc x *)
Definition set_up_edge_on_bc_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x3 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x4 := Sub (Mul x2 (Var "wc")) (Mul (Var "wb") x3) in
  let x5 := Add (Var "x0") (Num 1 (-1)) in
  let x6 := Sub (Var "pc") (Mul x5 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x5 (Var "wb")) in
  Mul x4 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x5 (Var "wa"))) x4) (Mul (Sub (Var "qa")
    (Mul x1 (Var "wa"))) (Sub (Mul (Var "wb") x6) (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul
    x7 x3) (Mul x2 x6)))) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective, where the sign of T is not known: ca 1 *)
Definition set_up_edge_on_ca_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qa") (Mul x3 (Var "wa")) in
  let x5 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x6 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x8 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  Mul (Sub (Mul x2 x4) (Mul x5 x6)) (Where (Less (Add (Add (Mul x6 (Sub (Mul x7 (Var "wc")) (Mul
    (Var "wb") x5))) (Mul x4 (Sub (Mul (Var "wb") x2) (Mul x8 (Var "wc"))))) (Mul (Var "wa") (Sub
    (Mul x8 x5) (Mul x7 x2)))) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective, where the sign of T is not known: ca y *)
Definition set_up_edge_on_ca_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x4 := Add (Var "y0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x4 (Var "wb")) in
  let x6 := Sub (Var "qc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  Mul (Sub (Mul (Var "wc") x2) (Mul x3 (Var "wa"))) (Where (Less (Add (Add (Mul x2 (Sub (Mul x5
    (Var "wc")) (Mul (Var "wb") x6))) (Mul (Sub (Var "qa") (Mul x4 (Var "wa"))) (Sub (Mul (Var "wb")
    x3) (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x7 x6) (Mul x5 x3)))) (Num 0 0))
    (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective, where the sign of T is not known: ca x *)
Definition set_up_edge_on_ca_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x3 := Sub (Var "qa") (Mul x1 (Var "wa")) in
  let x4 := Add (Var "x0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x6 := Sub (Var "pc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x4 (Var "wb")) in
  Mul (Sub (Mul x2 (Var "wa")) (Mul (Var "wc") x3)) (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul
    x4 (Var "wa"))) (Sub (Mul x5 (Var "wc")) (Mul (Var "wb") x2))) (Mul x3 (Sub (Mul (Var "wb") x6)
    (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x7 x2) (Mul x5 x6)))) (Num 0 0)) (Num (-1) 0)
    (Num 1 0)).

(** edge_functions.set_up, perspective, where the sign of T is not known: ab 1 *)
Definition set_up_edge_on_ab_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x5 := Sub (Var "qa") (Mul x3 (Var "wa")) in
  let x6 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x7 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x8 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  Mul (Sub (Mul x2 x4) (Mul x5 x6)) (Where (Less (Add (Add (Mul x2 (Sub (Mul x4 (Var "wc")) (Mul
    (Var "wb") x7))) (Mul x5 (Sub (Mul (Var "wb") x8) (Mul x6 (Var "wc"))))) (Mul (Var "wa") (Sub
    (Mul x6 x7) (Mul x4 x8)))) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective, where the sign of T is not known: ab y *)
Definition set_up_edge_on_ab_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x3 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x4 := Add (Var "y0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x4 (Var "wb")) in
  let x6 := Sub (Var "qc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  Mul (Sub (Mul (Var "wa") x2) (Mul x3 (Var "wb"))) (Where (Less (Add (Add (Mul x3 (Sub (Mul x5
    (Var "wc")) (Mul (Var "wb") x6))) (Mul (Sub (Var "qa") (Mul x4 (Var "wa"))) (Sub (Mul (Var "wb")
    x7) (Mul x2 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x2 x6) (Mul x5 x7)))) (Num 0 0))
    (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, perspective, where the sign of T is not known: ab x *)
Definition set_up_edge_on_ab_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x4 := Add (Var "x0") (Num 1 (-1)) in
  let x5 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x6 := Sub (Var "pc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x4 (Var "wb")) in
  Mul (Sub (Mul x2 (Var "wb")) (Mul (Var "wa") x3)) (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul
    x4 (Var "wa"))) (Sub (Mul x3 (Var "wc")) (Mul (Var "wb") x5))) (Mul x2 (Sub (Mul (Var "wb") x6)
    (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x7 x5) (Mul x3 x6)))) (Num 0 0)) (Num (-1) 0)
    (Num 1 0)).

(** edge_functions.set_up, perspective, where the sign of T is not known: nearness 1 *)
Definition set_up_edge_on_nearness_1 : expr :=
  Num 0 0.

(** edge_functions.set_up, perspective, where the sign of T is not known: nearness y *)
Definition set_up_edge_on_nearness_y : expr :=
  Num 0 0.

(** edge_functions.set_up, perspective, where the sign of T is not known: nearness x *)
Definition set_up_edge_on_nearness_x : expr :=
  Num 0 0.

(** edge_functions.set_up, perspective, where the sign of T is not known: edge error *)
Definition set_up_edge_on_edge_error : expr :=
  let x1 := Mul (Num 1 2) (Var "reach") in
  let x2 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x3 := Add (Var "c0") (Mul (Var "c1") x2) in
  let x4 := Mul (Var "weight") x2 in
  let x5 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x4 in
  let x6 := Add (Var "x0") (Num 1 (-1)) in
  let x7 := Add (Var "y0") (Num 1 (-1)) in
  let x8 := Add (Max (Max (Max (Max (Max (Abs (Sub (Var "pa") (Mul x6 (Var "wa")))) (Abs (Sub
    (Var "pb") (Mul x6 (Var "wb"))))) (Abs (Sub (Var "pc") (Mul x6 (Var "wc"))))) (Abs (Sub
    (Var "qa") (Mul x7 (Var "wa"))))) (Abs (Sub (Var "qb") (Mul x7 (Var "wb"))))) (Abs (Sub
    (Var "qc") (Mul x7 (Var "wc"))))) x3 in
  Add (Mul (Num 4548635623644201 (-52)) (Add (Add (Mul x1 (Add (Mul x3 x5) (Mul x8 x4))) (Mul (Mul
    (Num 1 2) x8) x3)) (Mul (Num 1 (-50)) (Mul x8 (Add (Mul x1 x5) (Mul (Num 1 1) x8))))))
    (Num 1 (-1000)).

(** edge_functions.set_up, perspective, where the sign of T is not known: sure *)
Definition set_up_edge_on_sure : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  And (Less (Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x11) (Add (Mul (Mul
    (Num 1 1) x10) x13) (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52)) x11) x11) x13)))
    (Num 1 (-1000))) x14) (Finite x14).

(** edge_functions.set_up, perspective, where the sign of T is not known: nearness error *)
Definition set_up_edge_on_nearness_error : expr :=
  Inf.

(** edge_functions.set_up, perspective, where the sign of T is not known: other bc 1 *)
Definition set_up_edge_on_other_bc_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x5 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x6 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  Mul (Mul x7 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x5
    (Var "wc")) (Mul (Var "wb") x4))) (Mul (Sub (Var "qa") (Mul x3 (Var "wa"))) (Sub (Mul (Var "wb")
    x6) (Mul x2 (Var "wc"))))) (Mul (Var "wa") x7)) (Num 0 0)) (Num (-1) 0) (Num 1 0))) (Num (-1) 0).

(** edge_functions.set_up, perspective, where the sign of T is not known: other bc y *)
Definition set_up_edge_on_other_bc_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Mul (Var "wb") x2) (Mul x3 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x7 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  Mul (Mul x4 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x6
    (Var "wc")) (Mul (Var "wb") x7))) (Mul (Sub (Var "qa") (Mul x5 (Var "wa"))) x4)) (Mul (Var "wa")
    (Sub (Mul x3 x7) (Mul x6 x2)))) (Num 0 0)) (Num (-1) 0) (Num 1 0))) (Num (-1) 0).

(** edge_functions.set_up, perspective, where the sign of T is not known: other bc x *)
Definition set_up_edge_on_other_bc_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x3 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x4 := Sub (Mul x2 (Var "wc")) (Mul (Var "wb") x3) in
  let x5 := Add (Var "x0") (Num 1 (-1)) in
  let x6 := Sub (Var "pc") (Mul x5 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x5 (Var "wb")) in
  Mul (Mul x4 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x5 (Var "wa"))) x4) (Mul (Sub
    (Var "qa") (Mul x1 (Var "wa"))) (Sub (Mul (Var "wb") x6) (Mul x7 (Var "wc"))))) (Mul (Var "wa")
    (Sub (Mul x7 x3) (Mul x2 x6)))) (Num 0 0)) (Num (-1) 0) (Num 1 0))) (Num (-1) 0).

(** edge_functions.set_up, perspective, where the sign of T is not known: other ca 1 *)
Definition set_up_edge_on_other_ca_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qa") (Mul x3 (Var "wa")) in
  let x5 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x6 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x8 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  Mul (Mul (Sub (Mul x2 x4) (Mul x5 x6)) (Where (Less (Add (Add (Mul x6 (Sub (Mul x7 (Var "wc"))
    (Mul (Var "wb") x5))) (Mul x4 (Sub (Mul (Var "wb") x2) (Mul x8 (Var "wc"))))) (Mul (Var "wa")
    (Sub (Mul x8 x5) (Mul x7 x2)))) (Num 0 0)) (Num (-1) 0) (Num 1 0))) (Num (-1) 0).

(** edge_functions.set_up, perspective, where the sign of T is not known: other ca y *)
Definition set_up_edge_on_other_ca_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x4 := Add (Var "y0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x4 (Var "wb")) in
  let x6 := Sub (Var "qc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  Mul (Mul (Sub (Mul (Var "wc") x2) (Mul x3 (Var "wa"))) (Where (Less (Add (Add (Mul x2 (Sub (Mul x5
    (Var "wc")) (Mul (Var "wb") x6))) (Mul (Sub (Var "qa") (Mul x4 (Var "wa"))) (Sub (Mul (Var "wb")
    x3) (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x7 x6) (Mul x5 x3)))) (Num 0 0))
    (Num (-1) 0) (Num 1 0))) (Num (-1) 0).

(** edge_functions.set_up, perspective, where the sign of T is not known: other ca x *)
Definition set_up_edge_on_other_ca_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x3 := Sub (Var "qa") (Mul x1 (Var "wa")) in
  let x4 := Add (Var "x0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x6 := Sub (Var "pc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x4 (Var "wb")) in
  Mul (Mul (Sub (Mul x2 (Var "wa")) (Mul (Var "wc") x3)) (Where (Less (Add (Add (Mul (Sub (Var "pa")
    (Mul x4 (Var "wa"))) (Sub (Mul x5 (Var "wc")) (Mul (Var "wb") x2))) (Mul x3 (Sub (Mul (Var "wb")
    x6) (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x7 x2) (Mul x5 x6)))) (Num 0 0))
    (Num (-1) 0) (Num 1 0))) (Num (-1) 0).

(** edge_functions.set_up, perspective, where the sign of T is not known: other ab 1 *)
Definition set_up_edge_on_other_ab_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x5 := Sub (Var "qa") (Mul x3 (Var "wa")) in
  let x6 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x7 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x8 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  Mul (Mul (Sub (Mul x2 x4) (Mul x5 x6)) (Where (Less (Add (Add (Mul x2 (Sub (Mul x4 (Var "wc"))
    (Mul (Var "wb") x7))) (Mul x5 (Sub (Mul (Var "wb") x8) (Mul x6 (Var "wc"))))) (Mul (Var "wa")
    (Sub (Mul x6 x7) (Mul x4 x8)))) (Num 0 0)) (Num (-1) 0) (Num 1 0))) (Num (-1) 0).

(** edge_functions.set_up, perspective, where the sign of T is not known: other ab y *)
Definition set_up_edge_on_other_ab_y : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x3 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x4 := Add (Var "y0") (Num 1 (-1)) in
  let x5 := Sub (Var "qb") (Mul x4 (Var "wb")) in
  let x6 := Sub (Var "qc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  Mul (Mul (Sub (Mul (Var "wa") x2) (Mul x3 (Var "wb"))) (Where (Less (Add (Add (Mul x3 (Sub (Mul x5
    (Var "wc")) (Mul (Var "wb") x6))) (Mul (Sub (Var "qa") (Mul x4 (Var "wa"))) (Sub (Mul (Var "wb")
    x7) (Mul x2 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x2 x6) (Mul x5 x7)))) (Num 0 0))
    (Num (-1) 0) (Num 1 0))) (Num (-1) 0).

(** edge_functions.set_up, perspective, where the sign of T is not known: other ab x *)
Definition set_up_edge_on_other_ab_x : expr :=
  let x1 := Add (Var "y0") (Num 1 (-1)) in
  let x2 := Sub (Var "qa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "qb") (Mul x1 (Var "wb")) in
  let x4 := Add (Var "x0") (Num 1 (-1)) in
  let x5 := Sub (Var "qc") (Mul x1 (Var "wc")) in
  let x6 := Sub (Var "pc") (Mul x4 (Var "wc")) in
  let x7 := Sub (Var "pb") (Mul x4 (Var "wb")) in
  Mul (Mul (Sub (Mul x2 (Var "wb")) (Mul (Var "wa") x3)) (Where (Less (Add (Add (Mul (Sub (Var "pa")
    (Mul x4 (Var "wa"))) (Sub (Mul x3 (Var "wc")) (Mul (Var "wb") x5))) (Mul x2 (Sub (Mul (Var "wb")
    x6) (Mul x7 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x7 x5) (Mul x3 x6)))) (Num 0 0))
    (Num (-1) 0) (Num 1 0))) (Num (-1) 0).

(** edge_functions.set_up, perspective, where the sign of T is not known: other nearness 1 *)
Definition set_up_edge_on_other_nearness_1 : expr :=
  Num 0 0.

(** edge_functions.set_up, perspective, where the sign of T is not known: other nearness y *)
Definition set_up_edge_on_other_nearness_y : expr :=
  Num 0 0.

(** edge_functions.set_up, perspective, where the sign of T is not known: other nearness x *)
Definition set_up_edge_on_other_nearness_x : expr :=
  Num 0 0.

(** edge_functions.set_up, perspective, where the sign of T is not known: other edge error *)
Definition set_up_edge_on_other_edge_error : expr :=
  let x1 := Mul (Num 1 2) (Var "reach") in
  let x2 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x3 := Add (Var "c0") (Mul (Var "c1") x2) in
  let x4 := Mul (Var "weight") x2 in
  let x5 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x4 in
  let x6 := Add (Var "x0") (Num 1 (-1)) in
  let x7 := Add (Var "y0") (Num 1 (-1)) in
  let x8 := Add (Max (Max (Max (Max (Max (Abs (Sub (Var "pa") (Mul x6 (Var "wa")))) (Abs (Sub
    (Var "pb") (Mul x6 (Var "wb"))))) (Abs (Sub (Var "pc") (Mul x6 (Var "wc"))))) (Abs (Sub
    (Var "qa") (Mul x7 (Var "wa"))))) (Abs (Sub (Var "qb") (Mul x7 (Var "wb"))))) (Abs (Sub
    (Var "qc") (Mul x7 (Var "wc"))))) x3 in
  Add (Mul (Num 4548635623644201 (-52)) (Add (Add (Mul x1 (Add (Mul x3 x5) (Mul x8 x4))) (Mul (Mul
    (Num 1 2) x8) x3)) (Mul (Num 1 (-50)) (Mul x8 (Add (Mul x1 x5) (Mul (Num 1 1) x8))))))
    (Num 1 (-1000)).

(** edge_functions.set_up, perspective, where the sign of T is not known: other sure *)
Definition set_up_edge_on_other_sure : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  And (Less (Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x11) (Add (Mul (Mul
    (Num 1 1) x10) x13) (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52)) x11) x11) x13)))
    (Num 1 (-1000))) x14) (Finite x14).

(** edge_functions.set_up, perspective, where the sign of T is not known: other nearness error *)
Definition set_up_edge_on_other_nearness_error : expr :=
  Inf.

(** edge_functions.set_up, perspective, where the sign of T is not known: T *)
Definition set_up_edge_on_T : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Add (Var "y0") (Num 1 (-1)) in
  let x3 := Sub (Var "qb") (Mul x2 (Var "wb")) in
  let x4 := Sub (Var "qc") (Mul x2 (Var "wc")) in
  let x5 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x6 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x3 (Var "wc")) (Mul (Var "wb") x4)))
    (Mul (Sub (Var "qa") (Mul x2 (Var "wa"))) (Sub (Mul (Var "wb") x5) (Mul x6 (Var "wc"))))) (Mul
    (Var "wa") (Sub (Mul x6 x4) (Mul x3 x5))).

(** edge_functions.set_up, perspective, where the sign of T is not known: T error *)
Definition set_up_edge_on_T_error : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Add (Var "y0") (Num 1 (-1)) in
  let x3 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x4 := Add (Var "c0") (Mul (Var "c1") x3) in
  let x5 := Add (Max (Max (Max (Max (Max (Abs (Sub (Var "pa") (Mul x1 (Var "wa")))) (Abs (Sub
    (Var "pb") (Mul x1 (Var "wb"))))) (Abs (Sub (Var "pc") (Mul x1 (Var "wc"))))) (Abs (Sub
    (Var "qa") (Mul x2 (Var "wa"))))) (Abs (Sub (Var "qb") (Mul x2 (Var "wb"))))) (Abs (Sub
    (Var "qc") (Mul x2 (Var "wc"))))) x4 in
  let x6 := Mul (Var "weight") x3 in
  let x7 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x6 in
  Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x5) (Add (Mul (Mul (Num 1 1) x4)
    x7) (Mul x5 x6))) (Mul (Mul (Mul (Num 25 (-52)) x5) x5) x7))) (Num 1 (-1000)).

(** edge_functions.set_up, perspective, where the sign of T is not known: path *)
Definition set_up_edge_on_path : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  And (Not (Not (Less (Mul x11 (Add (Mul (Mul (Num 1 2) (Var "reach")) x13) (Mul (Num 1 1) x11)))
    (Num 1 1000)))) (Not (And (Less (Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1)
    x11) (Add (Mul (Mul (Num 1 1) x10) x13) (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52)) x11) x11)
    x13))) (Num 1 (-1000))) x14) (Finite x14))).

(** edge_functions.set_up, parallel rays, where the sign of T is not known: bc 1 *)
Definition set_up_edge_on_parallel_bc_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x5 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x6 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  Mul x7 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x5 (Var "wc"))
    (Mul (Var "wb") x4))) (Mul (Sub (Var "qa") (Mul x3 (Var "wa"))) (Sub (Mul (Var "wb") x6) (Mul x2
    (Var "wc"))))) (Mul (Var "wa") x7)) (Num 0 0)) (Num (-1) 0) (Num 1 0)).

(** edge_functions.set_up, parallel rays, where the sign of T is not known: other bc 1 *)
Definition set_up_edge_on_parallel_other_bc_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "qc") (Mul x3 (Var "wc")) in
  let x5 := Sub (Var "qb") (Mul x3 (Var "wb")) in
  let x6 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  Mul (Mul x7 (Where (Less (Add (Add (Mul (Sub (Var "pa") (Mul x1 (Var "wa"))) (Sub (Mul x5
    (Var "wc")) (Mul (Var "wb") x4))) (Mul (Sub (Var "qa") (Mul x3 (Var "wa"))) (Sub (Mul (Var "wb")
    x6) (Mul x2 (Var "wc"))))) (Mul (Var "wa") x7)) (Num 0 0)) (Num (-1) 0) (Num 1 0))) (Num (-1) 0).

(** edge_functions.set_up, parallel rays, where the sign of T is not known: nearness 1 *)
Definition set_up_edge_on_parallel_nearness_1 : expr :=
  Num 0 0.

(** edge_functions.set_up, parallel rays, where the sign of T is not known: nearness error *)
Definition set_up_edge_on_parallel_nearness_error : expr :=
  Inf.

(** edge_functions.set_up, parallel rays, where the sign of T is not known: sure *)
Definition set_up_edge_on_parallel_sure : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  And (Less (Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x11) (Add (Mul (Mul
    (Num 1 1) x10) x13) (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52)) x11) x11) x13)))
    (Num 1 (-1000))) x14) (Finite x14).

(** edge_functions.set_up, parallel rays, where the sign of T is not known: path *)
Definition set_up_edge_on_parallel_path : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  And (Not (Not (Less (Mul (Mul x11 (Add (Mul (Mul (Num 1 2) (Var "reach")) x13) (Mul (Num 1 1)
    x11))) (Max (Max (Max (Max (Max (Abs (Var "ta")) (Abs (Var "tb"))) (Abs (Var "tc"))) (Abs (Sub
    (Var "tb") (Var "ta")))) (Abs (Sub (Var "tc") (Var "ta")))) (Num 1 0))) (Num 1 1000)))) (Not
    (And (Less (Add (Mul (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x11) (Add (Mul (Mul
    (Num 1 1) x10) x13) (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52)) x11) x11) x13)))
    (Num 1 (-1000))) x14) (Finite x14))).

(** edge_functions.set_up, perspective, where numbers are too large: bc 1 *)
Definition set_up_lost_perspective_bc_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    (Add (Var "c0") (Mul (Var "c1") x9)) in
  let x11 := Sub (Mul x3 x8) (Mul x7 x4) in
  Where (Not (Less (Mul x10 (Add (Mul (Mul (Num 1 2) (Var "reach")) (Add (Max (Max (Abs (Var "wa"))
    (Abs (Var "wb"))) (Abs (Var "wc"))) (Mul (Var "weight") x9))) (Mul (Num 1 1) x10)))
    (Num 1 1000))) (Num 0 0) (Mul x11 (Where (Less (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul
    (Var "wb") x8))) (Mul x6 (Sub (Mul (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") x11))
    (Num 0 0)) (Num (-1) 0) (Num 1 0))).

(** edge_functions.set_up, perspective, where numbers are too large: edge error *)
Definition set_up_lost_perspective_edge_error : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Add (Var "y0") (Num 1 (-1)) in
  let x3 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x4 := Add (Var "c0") (Mul (Var "c1") x3) in
  let x5 := Add (Max (Max (Max (Max (Max (Abs (Sub (Var "pa") (Mul x1 (Var "wa")))) (Abs (Sub
    (Var "pb") (Mul x1 (Var "wb"))))) (Abs (Sub (Var "pc") (Mul x1 (Var "wc"))))) (Abs (Sub
    (Var "qa") (Mul x2 (Var "wa"))))) (Abs (Sub (Var "qb") (Mul x2 (Var "wb"))))) (Abs (Sub
    (Var "qc") (Mul x2 (Var "wc"))))) x4 in
  let x6 := Mul (Num 1 2) (Var "reach") in
  let x7 := Mul (Var "weight") x3 in
  let x8 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x7 in
  let x9 := Mul x5 (Add (Mul x6 x8) (Mul (Num 1 1) x5)) in
  Where (Not (Less x9 (Num 1 1000))) Inf (Add (Mul (Num 4548635623644201 (-52)) (Add (Add (Mul x6
    (Add (Mul x4 x8) (Mul x5 x7))) (Mul (Mul (Num 1 2) x5) x4)) (Mul (Num 1 (-50)) x9)))
    (Num 1 (-1000))).

(** edge_functions.set_up, perspective, where numbers are too large: nearness 1 *)
Definition set_up_lost_perspective_nearness_1 : expr :=
  Num 0 0.

(** edge_functions.set_up, perspective, where numbers are too large: nearness error *)
Definition set_up_lost_perspective_nearness_error : expr :=
  Inf.

(** edge_functions.set_up, perspective, where numbers are too large: sure *)
Definition set_up_lost_perspective_sure : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Not (Less (Mul x11 (Add (Mul (Mul (Num 1 2) (Var "reach")) x13) (Mul (Num 1 1) x11)))
    (Num 1 1000)) in
  let x15 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  Or (And x14 (Not (Same (Num 0 0) (Num 0 0)))) (And (Not x14) (And (Less (Add (Mul
    (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x11) (Add (Mul (Mul (Num 1 1) x10) x13)
    (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52)) x11) x11) x13))) (Num 1 (-1000))) x15) (Finite
    x15))).

(** edge_functions.set_up, perspective, where numbers are too large: path *)
Definition set_up_lost_perspective_path : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Not (Less (Mul x11 (Add (Mul (Mul (Num 1 2) (Var "reach")) x13) (Mul (Num 1 1) x11)))
    (Num 1 1000)) in
  let x15 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  And x14 (Not (Or (And x14 (Not (Same (Num 0 0) (Num 0 0)))) (And (Not x14) (And (Less (Add (Mul
    (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x11) (Add (Mul (Mul (Num 1 1) x10) x13)
    (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52)) x11) x11) x13))) (Num 1 (-1000))) x15) (Finite
    x15))))).

(** edge_functions.set_up, orthographic, where numbers are too large: bc 1 *)
Definition set_up_lost_parallel_bc_1 : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    (Add (Var "c0") (Mul (Var "c1") x9)) in
  let x11 := Sub (Mul x3 x8) (Mul x7 x4) in
  Where (Not (Less (Mul (Mul x10 (Add (Mul (Mul (Num 1 2) (Var "reach")) (Add (Max (Max (Abs
    (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) (Mul (Var "weight") x9))) (Mul (Num 1 1) x10)))
    (Max (Max (Max (Max (Max (Abs (Var "ta")) (Abs (Var "tb"))) (Abs (Var "tc"))) (Abs (Sub
    (Var "tb") (Var "ta")))) (Abs (Sub (Var "tc") (Var "ta")))) (Num 1 0))) (Num 1 1000))) (Num 0 0)
    (Mul x11 (Where (Less (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6
    (Sub (Mul (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") x11)) (Num 0 0)) (Num (-1) 0)
    (Num 1 0))).

(** edge_functions.set_up, orthographic, where numbers are too large: edge error *)
Definition set_up_lost_parallel_edge_error : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Add (Var "y0") (Num 1 (-1)) in
  let x3 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x4 := Add (Var "c0") (Mul (Var "c1") x3) in
  let x5 := Add (Max (Max (Max (Max (Max (Abs (Sub (Var "pa") (Mul x1 (Var "wa")))) (Abs (Sub
    (Var "pb") (Mul x1 (Var "wb"))))) (Abs (Sub (Var "pc") (Mul x1 (Var "wc"))))) (Abs (Sub
    (Var "qa") (Mul x2 (Var "wa"))))) (Abs (Sub (Var "qb") (Mul x2 (Var "wb"))))) (Abs (Sub
    (Var "qc") (Mul x2 (Var "wc"))))) x4 in
  let x6 := Mul (Num 1 2) (Var "reach") in
  let x7 := Mul (Var "weight") x3 in
  let x8 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x7 in
  let x9 := Mul x5 (Add (Mul x6 x8) (Mul (Num 1 1) x5)) in
  Where (Not (Less (Mul x9 (Max (Max (Max (Max (Max (Abs (Var "ta")) (Abs (Var "tb"))) (Abs
    (Var "tc"))) (Abs (Sub (Var "tb") (Var "ta")))) (Abs (Sub (Var "tc") (Var "ta")))) (Num 1 0)))
    (Num 1 1000))) Inf (Add (Mul (Num 4548635623644201 (-52)) (Add (Add (Mul x6 (Add (Mul x4 x8)
    (Mul x5 x7))) (Mul (Mul (Num 1 2) x5) x4)) (Mul (Num 1 (-50)) x9))) (Num 1 (-1000))).

(** edge_functions.set_up, orthographic, where numbers are too large: nearness 1 *)
Definition set_up_lost_parallel_nearness_1 : expr :=
  Num 0 0.

(** edge_functions.set_up, orthographic, where numbers are too large: nearness error *)
Definition set_up_lost_parallel_nearness_error : expr :=
  Inf.

(** edge_functions.set_up, orthographic, where numbers are too large: sure *)
Definition set_up_lost_parallel_sure : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Not (Less (Mul (Mul x11 (Add (Mul (Mul (Num 1 2) (Var "reach")) x13) (Mul (Num 1 1)
    x11))) (Max (Max (Max (Max (Max (Abs (Var "ta")) (Abs (Var "tb"))) (Abs (Var "tc"))) (Abs (Sub
    (Var "tb") (Var "ta")))) (Abs (Sub (Var "tc") (Var "ta")))) (Num 1 0))) (Num 1 1000)) in
  let x15 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  Or (And x14 (Not (Same (Num 0 0) (Num 0 0)))) (And (Not x14) (And (Less (Add (Mul
    (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x11) (Add (Mul (Mul (Num 1 1) x10) x13)
    (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52)) x11) x11) x13))) (Num 1 (-1000))) x15) (Finite
    x15))).

(** edge_functions.set_up, orthographic, where numbers are too large: path *)
Definition set_up_lost_parallel_path : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "pa") (Mul x1 (Var "wa")) in
  let x3 := Sub (Var "pb") (Mul x1 (Var "wb")) in
  let x4 := Sub (Var "pc") (Mul x1 (Var "wc")) in
  let x5 := Add (Var "y0") (Num 1 (-1)) in
  let x6 := Sub (Var "qa") (Mul x5 (Var "wa")) in
  let x7 := Sub (Var "qb") (Mul x5 (Var "wb")) in
  let x8 := Sub (Var "qc") (Mul x5 (Var "wc")) in
  let x9 := Max (Max (Var "sa") (Var "sb")) (Var "sc") in
  let x10 := Add (Var "c0") (Mul (Var "c1") x9) in
  let x11 := Add (Max (Max (Max (Max (Max (Abs x2) (Abs x3)) (Abs x4)) (Abs x6)) (Abs x7)) (Abs x8))
    x10 in
  let x12 := Mul (Var "weight") x9 in
  let x13 := Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) x12 in
  let x14 := Not (Less (Mul (Mul x11 (Add (Mul (Mul (Num 1 2) (Var "reach")) x13) (Mul (Num 1 1)
    x11))) (Max (Max (Max (Max (Max (Abs (Var "ta")) (Abs (Var "tb"))) (Abs (Var "tc"))) (Abs (Sub
    (Var "tb") (Var "ta")))) (Abs (Sub (Var "tc") (Var "ta")))) (Num 1 0))) (Num 1 1000)) in
  let x15 := Abs (Add (Add (Mul x2 (Sub (Mul x7 (Var "wc")) (Mul (Var "wb") x8))) (Mul x6 (Sub (Mul
    (Var "wb") x4) (Mul x3 (Var "wc"))))) (Mul (Var "wa") (Sub (Mul x3 x8) (Mul x7 x4)))) in
  And x14 (Not (Or (And x14 (Not (Same (Num 0 0) (Num 0 0)))) (And (Not x14) (And (Less (Add (Mul
    (Num 4548635623644201 (-52)) (Add (Mul (Mul (Num 3 1) x11) (Add (Mul (Mul (Num 1 1) x10) x13)
    (Mul x11 x12))) (Mul (Mul (Mul (Num 25 (-52)) x11) x11) x13))) (Num 1 (-1000))) x15) (Finite
    x15))))).

(** rasterise._block: edge *)
Definition block_edge : expr :=
  let x1 := Add (Add (Var "y") (Sub (Var "region_y") (Var "origin_y"))) (Num 0 0) in
  let x2 := Add (Add (Var "x") (Sub (Var "region_x") (Var "origin_x"))) (Num 0 0) in
  Min (Min (Add (Add (Var "bc_1") (Mul (Var "bc_y") x1)) (Mul (Var "bc_x") x2)) (Add (Add
    (Var "ca_1") (Mul (Var "ca_y") x1)) (Mul (Var "ca_x") x2))) (Add (Add (Var "ab_1") (Mul
    (Var "ab_y") x1)) (Mul (Var "ab_x") x2)).

(** rasterise._block: inside *)
Definition block_inside : test :=
  let x1 := Add (Add (Var "y") (Sub (Var "region_y") (Var "origin_y"))) (Num 0 0) in
  let x2 := Add (Add (Var "x") (Sub (Var "region_x") (Var "origin_x"))) (Num 0 0) in
  LessEq (Neg (Var "edge_error")) (Min (Min (Add (Add (Var "bc_1") (Mul (Var "bc_y") x1)) (Mul
    (Var "bc_x") x2)) (Add (Add (Var "ca_1") (Mul (Var "ca_y") x1)) (Mul (Var "ca_x") x2))) (Add
    (Add (Var "ab_1") (Mul (Var "ab_y") x1)) (Mul (Var "ab_x") x2))).

(** rasterise._block: least *)
Definition block_least : expr :=
  Sub (Add (Add (Var "nearness_1") (Mul (Var "nearness_y") (Add (Add (Var "y") (Sub (Var "region_y")
    (Var "origin_y"))) (Num 0 0)))) (Mul (Var "nearness_x") (Add (Add (Var "x") (Sub
    (Var "region_x") (Var "origin_x"))) (Num 0 0)))) (Var "nearness_error").

(** rasterise._block: most *)
Definition block_most : expr :=
  Min (Add (Add (Add (Var "nearness_1") (Mul (Var "nearness_y") (Add (Add (Var "y") (Sub
    (Var "region_y") (Var "origin_y"))) (Num 0 0)))) (Mul (Var "nearness_x") (Add (Add (Var "x")
    (Sub (Var "region_x") (Var "origin_x"))) (Num 0 0)))) (Var "nearness_error")) (Var "nearest").

(** rasterise._block: sure *)
Definition block_sure : test :=
  let x1 := Add (Add (Var "y") (Sub (Var "region_y") (Var "origin_y"))) (Num 0 0) in
  let x2 := Add (Add (Var "x") (Sub (Var "region_x") (Var "origin_x"))) (Num 0 0) in
  And (Less (Var "edge_error") (Min (Min (Add (Add (Var "bc_1") (Mul (Var "bc_y") x1)) (Mul
    (Var "bc_x") x2)) (Add (Add (Var "ca_1") (Mul (Var "ca_y") x1)) (Mul (Var "ca_x") x2))) (Add
    (Add (Var "ab_1") (Mul (Var "ab_y") x1)) (Mul (Var "ab_x") x2)))) (Given "sure").

(** rasterise._may_be_seen *)
Definition may_be_seen : test :=
  let x1 := Add (Var "y") (Sub (Var "region_y") (Var "origin_y")) in
  let x2 := Add x1 (Sub (Var "y_end") (Var "y")) in
  let x3 := Add (Var "x") (Sub (Var "region_x") (Var "origin_x")) in
  let x4 := Add x3 (Sub (Var "x_end") (Var "x")) in
  Not (Or (Less (Min (Min (Add (Add (Var "bc_1") (Mul (Var "bc_y") (Where (Less (Num 0 0)
    (Var "bc_y")) x2 x1))) (Mul (Var "bc_x") (Where (Less (Num 0 0) (Var "bc_x")) x4 x3))) (Add (Add
    (Var "ca_1") (Mul (Var "ca_y") (Where (Less (Num 0 0) (Var "ca_y")) x2 x1))) (Mul (Var "ca_x")
    (Where (Less (Num 0 0) (Var "ca_x")) x4 x3)))) (Add (Add (Var "ab_1") (Mul (Var "ab_y") (Where
    (Less (Num 0 0) (Var "ab_y")) x2 x1))) (Mul (Var "ab_x") (Where (Less (Num 0 0) (Var "ab_x")) x4
    x3)))) (Neg (Var "edge_error"))) (Less (Add (Add (Add (Var "nearness_1") (Mul (Var "nearness_y")
    (Where (Less (Num 0 0) (Var "nearness_y")) x2 x1))) (Mul (Var "nearness_x") (Where (Less
    (Num 0 0) (Var "nearness_x")) x4 x3))) (Var "nearness_error")) (Var "farthest"))).

(** small_boxes.small_pairs: T *)
Definition small_T : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xb") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "yc") x3 in
  let x5 := Sub (Var "yb") x3 in
  let x6 := Sub (Var "xc") x1 in
  let x7 := Sub (Var "ya") x3 in
  let x8 := Sub (Var "xa") x1 in
  Add (Add (Sub (Mul x2 x4) (Mul x5 x6)) (Sub (Mul x6 x7) (Mul x4 x8))) (Sub (Mul x8 x5) (Mul x7
    x2)).

(** small_boxes.small_pairs: edge *)
Definition small_edge : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xb") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "yc") x3 in
  let x5 := Sub (Var "yb") x3 in
  let x6 := Sub (Var "xc") x1 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Sub (Var "ya") x3 in
  let x9 := Sub (Var "xa") x1 in
  let x10 := Sub (Mul x6 x8) (Mul x4 x9) in
  let x11 := Sub (Mul x9 x5) (Mul x8 x2) in
  let x12 := CopySign (Num 1 0) (Add (Add x7 x10) x11) in
  Min (Min (Add (Add (Mul x7 x12) (Mul (Mul (Sub x6 x2) x12) (Var "up"))) (Mul (Mul (Sub x5 x4) x12)
    (Var "right"))) (Add (Add (Mul x10 x12) (Mul (Mul (Sub x9 x6) x12) (Var "up"))) (Mul (Mul (Sub
    x4 x8) x12) (Var "right")))) (Add (Add (Mul x11 x12) (Mul (Mul (Sub x2 x9) x12) (Var "up")))
    (Mul (Mul (Sub x8 x5) x12) (Var "right"))).

(** small_boxes.small_pairs: inside *)
Definition small_inside : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xb") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "yc") x3 in
  let x5 := Sub (Var "yb") x3 in
  let x6 := Sub (Var "xc") x1 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Sub (Var "ya") x3 in
  let x9 := Sub (Var "xa") x1 in
  let x10 := Sub (Mul x6 x8) (Mul x4 x9) in
  let x11 := Sub (Mul x9 x5) (Mul x8 x2) in
  let x12 := CopySign (Num 1 0) (Add (Add x7 x10) x11) in
  LessEq (Num (-2345391125639987) (-69)) (Min (Min (Add (Add (Mul x7 x12) (Mul (Mul (Sub x6 x2) x12)
    (Var "up"))) (Mul (Mul (Sub x5 x4) x12) (Var "right"))) (Add (Add (Mul x10 x12) (Mul (Mul (Sub
    x9 x6) x12) (Var "up"))) (Mul (Mul (Sub x4 x8) x12) (Var "right")))) (Add (Add (Mul x11 x12)
    (Mul (Mul (Sub x2 x9) x12) (Var "up"))) (Mul (Mul (Sub x8 x5) x12) (Var "right")))).

(** small_boxes.small_pairs: least *)
Definition small_least : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xc") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "ya") x3 in
  let x5 := Sub (Var "yc") x3 in
  let x6 := Sub (Var "xa") x1 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Sub (Var "xb") x1 in
  let x9 := Sub (Var "yb") x3 in
  let x10 := Sub (Mul x6 x9) (Mul x4 x8) in
  let x11 := Add (Add (Sub (Mul x8 x5) (Mul x9 x2)) x7) x10 in
  let x12 := CopySign (Num 1 0) x11 in
  let x13 := Sub (Var "nb") (Var "na") in
  let x14 := Div (Num 1 0) (Max (Abs x11) (Num 7249389938113249 (-69))) in
  let x15 := Sub (Var "nc") (Var "na") in
  Sub (Add (Add (Mul (Add (Add (Mul x7 x12) (Mul (Mul (Sub x6 x2) x12) (Var "up"))) (Mul (Mul (Sub
    x5 x4) x12) (Var "right"))) (Mul x13 x14)) (Mul (Add (Add (Mul x10 x12) (Mul (Mul (Sub x8 x6)
    x12) (Var "up"))) (Mul (Mul (Sub x4 x9) x12) (Var "right"))) (Mul x15 x14))) (Var "na")) (Add
    (Mul (Mul (Max (Abs x13) (Abs x15)) x14) (Num 1130585054183171 (-63))) (Mul
    (Num 6756061982938979 (-48)) (Var "own"))).

(** small_boxes.small_pairs: most *)
Definition small_most : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xc") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "ya") x3 in
  let x5 := Sub (Var "yc") x3 in
  let x6 := Sub (Var "xa") x1 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Sub (Var "xb") x1 in
  let x9 := Sub (Var "yb") x3 in
  let x10 := Sub (Mul x6 x9) (Mul x4 x8) in
  let x11 := Add (Add (Sub (Mul x8 x5) (Mul x9 x2)) x7) x10 in
  let x12 := CopySign (Num 1 0) x11 in
  let x13 := Sub (Var "nb") (Var "na") in
  let x14 := Div (Num 1 0) (Max (Abs x11) (Num 7249389938113249 (-69))) in
  let x15 := Sub (Var "nc") (Var "na") in
  Add (Add (Add (Mul (Add (Add (Mul x7 x12) (Mul (Mul (Sub x6 x2) x12) (Var "up"))) (Mul (Mul (Sub
    x5 x4) x12) (Var "right"))) (Mul x13 x14)) (Mul (Add (Add (Mul x10 x12) (Mul (Mul (Sub x8 x6)
    x12) (Var "up"))) (Mul (Mul (Sub x4 x9) x12) (Var "right"))) (Mul x15 x14))) (Var "na")) (Add
    (Mul (Mul (Max (Abs x13) (Abs x15)) x14) (Num 1130585054183171 (-63))) (Mul
    (Num 6756061982938979 (-48)) (Var "own"))).

(** small_boxes.small_pairs: sure *)
Definition small_sure : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xb") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "yc") x3 in
  let x5 := Sub (Var "yb") x3 in
  let x6 := Sub (Var "xc") x1 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Sub (Var "ya") x3 in
  let x9 := Sub (Var "xa") x1 in
  let x10 := Sub (Mul x6 x8) (Mul x4 x9) in
  let x11 := Sub (Mul x9 x5) (Mul x8 x2) in
  let x12 := CopySign (Num 1 0) (Add (Add x7 x10) x11) in
  Less (Num 2345391125639987 (-69)) (Min (Min (Add (Add (Mul x7 x12) (Mul (Mul (Sub x6 x2) x12)
    (Var "up"))) (Mul (Mul (Sub x5 x4) x12) (Var "right"))) (Add (Add (Mul x10 x12) (Mul (Mul (Sub
    x9 x6) x12) (Var "up"))) (Mul (Mul (Sub x4 x8) x12) (Var "right")))) (Add (Add (Mul x11 x12)
    (Mul (Mul (Sub x2 x9) x12) (Var "up"))) (Mul (Mul (Sub x8 x5) x12) (Var "right")))).

(** small_boxes.small_pairs: path *)
Definition small_path : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xb") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "yc") x3 in
  let x5 := Sub (Var "yb") x3 in
  let x6 := Sub (Var "xc") x1 in
  let x7 := Sub (Var "ya") x3 in
  let x8 := Sub (Var "xa") x1 in
  Not (LessEq (Abs (Add (Add (Sub (Mul x2 x4) (Mul x5 x6)) (Sub (Mul x6 x7) (Mul x4 x8))) (Sub (Mul
    x8 x5) (Mul x7 x2)))) (Num 7249389938113249 (-69))).

(** small_boxes.small_pairs, a box of one pixel: T *)
Definition small_one_T : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xb") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "yc") x3 in
  let x5 := Sub (Var "yb") x3 in
  let x6 := Sub (Var "xc") x1 in
  let x7 := Sub (Var "ya") x3 in
  let x8 := Sub (Var "xa") x1 in
  Add (Add (Sub (Mul x2 x4) (Mul x5 x6)) (Sub (Mul x6 x7) (Mul x4 x8))) (Sub (Mul x8 x5) (Mul x7
    x2)).

(** small_boxes.small_pairs, a box of one pixel: edge *)
Definition small_one_edge : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xb") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "yc") x3 in
  let x5 := Sub (Var "yb") x3 in
  let x6 := Sub (Var "xc") x1 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Sub (Var "ya") x3 in
  let x9 := Sub (Var "xa") x1 in
  let x10 := Sub (Mul x6 x8) (Mul x4 x9) in
  let x11 := Sub (Mul x9 x5) (Mul x8 x2) in
  let x12 := CopySign (Num 1 0) (Add (Add x7 x10) x11) in
  Min (Min (Mul x7 x12) (Mul x10 x12)) (Mul x11 x12).

(** small_boxes.small_pairs, a box of one pixel: inside *)
Definition small_one_inside : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xb") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "yc") x3 in
  let x5 := Sub (Var "yb") x3 in
  let x6 := Sub (Var "xc") x1 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Sub (Var "ya") x3 in
  let x9 := Sub (Var "xa") x1 in
  let x10 := Sub (Mul x6 x8) (Mul x4 x9) in
  let x11 := Sub (Mul x9 x5) (Mul x8 x2) in
  let x12 := CopySign (Num 1 0) (Add (Add x7 x10) x11) in
  LessEq (Num (-2345391125639987) (-69)) (Min (Min (Mul x7 x12) (Mul x10 x12)) (Mul x11 x12)).

(** small_boxes.small_pairs, a box of one pixel: least *)
Definition small_one_least : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xc") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "ya") x3 in
  let x5 := Sub (Var "yc") x3 in
  let x6 := Sub (Var "xa") x1 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Sub (Var "xb") x1 in
  let x9 := Sub (Var "yb") x3 in
  let x10 := Sub (Mul x6 x9) (Mul x4 x8) in
  let x11 := Add (Add (Sub (Mul x8 x5) (Mul x9 x2)) x7) x10 in
  let x12 := CopySign (Num 1 0) x11 in
  let x13 := Sub (Var "nb") (Var "na") in
  let x14 := Div (Num 1 0) (Max (Abs x11) (Num 7249389938113249 (-69))) in
  let x15 := Sub (Var "nc") (Var "na") in
  Sub (Add (Add (Mul (Mul x7 x12) (Mul x13 x14)) (Mul (Mul x10 x12) (Mul x15 x14))) (Var "na")) (Add
    (Mul (Mul (Max (Abs x13) (Abs x15)) x14) (Num 1130585054183171 (-63))) (Mul
    (Num 6756061982938979 (-48)) (Var "own"))).

(** small_boxes.small_pairs, a box of one pixel: most *)
Definition small_one_most : expr :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xc") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "ya") x3 in
  let x5 := Sub (Var "yc") x3 in
  let x6 := Sub (Var "xa") x1 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Sub (Var "xb") x1 in
  let x9 := Sub (Var "yb") x3 in
  let x10 := Sub (Mul x6 x9) (Mul x4 x8) in
  let x11 := Add (Add (Sub (Mul x8 x5) (Mul x9 x2)) x7) x10 in
  let x12 := CopySign (Num 1 0) x11 in
  let x13 := Sub (Var "nb") (Var "na") in
  let x14 := Div (Num 1 0) (Max (Abs x11) (Num 7249389938113249 (-69))) in
  let x15 := Sub (Var "nc") (Var "na") in
  Add (Add (Add (Mul (Mul x7 x12) (Mul x13 x14)) (Mul (Mul x10 x12) (Mul x15 x14))) (Var "na")) (Add
    (Mul (Mul (Max (Abs x13) (Abs x15)) x14) (Num 1130585054183171 (-63))) (Mul
    (Num 6756061982938979 (-48)) (Var "own"))).

(** small_boxes.small_pairs, a box of one pixel: sure *)
Definition small_one_sure : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xb") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "yc") x3 in
  let x5 := Sub (Var "yb") x3 in
  let x6 := Sub (Var "xc") x1 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Sub (Var "ya") x3 in
  let x9 := Sub (Var "xa") x1 in
  let x10 := Sub (Mul x6 x8) (Mul x4 x9) in
  let x11 := Sub (Mul x9 x5) (Mul x8 x2) in
  let x12 := CopySign (Num 1 0) (Add (Add x7 x10) x11) in
  Less (Num 2345391125639987 (-69)) (Min (Min (Mul x7 x12) (Mul x10 x12)) (Mul x11 x12)).

(** small_boxes.small_pairs, a box of one pixel: path *)
Definition small_one_path : test :=
  let x1 := Add (Var "x0") (Num 1 (-1)) in
  let x2 := Sub (Var "xb") x1 in
  let x3 := Add (Var "y0") (Num 1 (-1)) in
  let x4 := Sub (Var "yc") x3 in
  let x5 := Sub (Var "yb") x3 in
  let x6 := Sub (Var "xc") x1 in
  let x7 := Sub (Var "ya") x3 in
  let x8 := Sub (Var "xa") x1 in
  Not (LessEq (Abs (Add (Add (Sub (Mul x2 x4) (Mul x5 x6)) (Sub (Mul x6 x7) (Mul x4 x8))) (Sub (Mul
    x8 x5) (Mul x7 x2)))) (Num 7249389938113249 (-69))).

(** depth_buffer.ClipRange, perspective: inside *)
Definition clip_perspective_inside : test :=
  And (Less (Div (Num 2251799813685249 (-51)) (Var "end")) (Var "least")) (Less (Var "most") (Div
    (Num 2251799813685247 (-51)) (Max (Var "start") (Num 0 0)))).

(** depth_buffer.ClipRange, perspective: outside *)
Definition clip_perspective_outside : test :=
  Or (Less (Var "most") (Div (Num 2251799813685247 (-51)) (Var "end"))) (Less (Div
    (Num 2251799813685249 (-51)) (Max (Var "start") (Num 0 0))) (Var "least")).

(** depth_buffer.ClipRange, orthographic: inside *)
Definition clip_parallel_inside : test :=
  And (Less (Neg (Var "end")) (Var "least")) (Less (Var "most") (Where (Finite (Var "start")) (Neg
    (Var "start")) Inf)).

(** depth_buffer.ClipRange, orthographic: outside *)
Definition clip_parallel_outside : test :=
  Or (Less (Var "most") (Neg (Var "end"))) (Less (Where (Finite (Var "start")) (Neg (Var "start"))
    Inf) (Var "least")).

(** sweep.Sweep.enter_planes, perspective: least *)
Definition plane_pixel_perspective_least : expr :=
  Div (Num 2251799813685247 (-51)) (Var "high").

(** sweep.Sweep.enter_planes, perspective: most *)
Definition plane_pixel_perspective_most : expr :=
  Div (Num 2251799813685249 (-51)) (Max (Var "low") (Num 0 0)).

(** sweep.Sweep.enter_planes, perspective: sure *)
Definition plane_pixel_perspective_sure : test :=
  Finite (Var "high").

(** sweep.Sweep.enter_planes, orthographic: least *)
Definition plane_pixel_parallel_least : expr :=
  Neg (Var "high").

(** sweep.Sweep.enter_planes, orthographic: most *)
Definition plane_pixel_parallel_most : expr :=
  Where (Finite (Var "high")) (Neg (Var "low")) Inf.

(** sweep.Sweep.enter_planes, orthographic: sure *)
Definition plane_pixel_parallel_sure : test :=
  Finite (Var "high").

(** depth_buffer.DepthBuffer.enter, where it wins, and the winner before is a rival: nearer *)
Definition enter_nearer : test :=
  Less (Var "winner_least") (Var "least").

(** depth_buffer.DepthBuffer.enter, where it wins, and the winner before is a rival: winner may be
    nearer *)
Definition enter_winner_may_be_nearer : test :=
  Not (Less (Var "winner_most") (Var "least")).

(** depth_buffer.DepthBuffer.enter, where it wins, and the winner before is a rival: nearness *)
Definition enter_nearness : expr :=
  Var "least".

(** depth_buffer.DepthBuffer.enter, where it wins, and the winner before is a rival: path *)
Definition enter_path : test :=
  And (Less (Var "winner_least") (Var "least")) (Not (Less (Var "winner_most") (Var "least"))).

(** film.Film.enter, perspective: p *)
Definition film_perspective_p : expr :=
  let x1 := Sub (Var "vx") (Var "ox") in
  let x2 := Sub (Var "vy") (Var "oy") in
  let x3 := Sub (Var "vz") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  Sub (Mul (Sub (Add (Add (Mul (Var "right_x") x1) (Mul (Var "right_y") x2)) (Mul (Var "right_z")
    x3)) (Mul (Var "left") x4)) (Div (Num 1 0) (Div (Sub (Var "right") (Var "left"))
    (Var "width")))) (Mul (Var "dx") x4).

(** film.Film.enter, perspective: q *)
Definition film_perspective_q : expr :=
  let x1 := Sub (Var "vx") (Var "ox") in
  let x2 := Sub (Var "vy") (Var "oy") in
  let x3 := Sub (Var "vz") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  Sub (Mul (Sub (Add (Add (Mul (Var "up_x") x1) (Mul (Var "up_y") x2)) (Mul (Var "up_z") x3)) (Mul
    (Var "bottom") x4)) (Div (Num 1 0) (Div (Sub (Var "top") (Var "bottom")) (Var "height")))) (Mul
    (Var "dy") x4).

(** film.Film.enter, perspective: w *)
Definition film_perspective_w : expr :=
  Add (Add (Mul (Var "depth_x") (Sub (Var "vx") (Var "ox"))) (Mul (Var "depth_y") (Sub (Var "vy")
    (Var "oy")))) (Mul (Var "depth_z") (Sub (Var "vz") (Var "oz"))).

(** film.Film.enter, perspective: depth *)
Definition film_perspective_depth : expr :=
  Add (Add (Mul (Var "depth_x") (Sub (Var "vx") (Var "ox"))) (Mul (Var "depth_y") (Sub (Var "vy")
    (Var "oy")))) (Mul (Var "depth_z") (Sub (Var "vz") (Var "oz"))).

(** film.Film.enter, perspective: size *)
Definition film_perspective_size : expr :=
  Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs (Var "ox"))
    (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))).

(** film.Film.enter, perspective: x *)
Definition film_perspective_x : expr :=
  let x1 := Sub (Var "vx") (Var "ox") in
  let x2 := Sub (Var "vy") (Var "oy") in
  let x3 := Sub (Var "vz") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  Div (Sub (Mul (Sub (Add (Add (Mul (Var "right_x") x1) (Mul (Var "right_y") x2)) (Mul
    (Var "right_z") x3)) (Mul (Var "left") x4)) (Div (Num 1 0) (Div (Sub (Var "right") (Var "left"))
    (Var "width")))) (Mul (Var "dx") x4)) x4.

(** film.Film.enter, perspective: y *)
Definition film_perspective_y : expr :=
  let x1 := Sub (Var "vx") (Var "ox") in
  let x2 := Sub (Var "vy") (Var "oy") in
  let x3 := Sub (Var "vz") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  Div (Sub (Mul (Sub (Add (Add (Mul (Var "up_x") x1) (Mul (Var "up_y") x2)) (Mul (Var "up_z") x3))
    (Mul (Var "bottom") x4)) (Div (Num 1 0) (Div (Sub (Var "top") (Var "bottom")) (Var "height"))))
    (Mul (Var "dy") x4)) x4.

(** film.Film.enter, perspective: nearest *)
Definition film_perspective_nearest : expr :=
  Div (Add (Num 281474976710657 (-48)) (Mul (Num 1 1) (Var "ray_error"))) (Max (Sub (Add (Add (Mul
    (Var "depth_x") (Sub (Var "vx") (Var "ox"))) (Mul (Var "depth_y") (Sub (Var "vy") (Var "oy"))))
    (Mul (Var "depth_z") (Sub (Var "vz") (Var "oz")))) (Mul (Var "weight") (Add (Max (Max (Abs
    (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs (Var "ox")) (Abs
    (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960)))))) (Var "clip_start")).

(** film.Film.enter, perspective: ahead *)
Definition film_perspective_ahead : test :=
  let x1 := Sub (Var "vx") (Var "ox") in
  let x2 := Sub (Var "vy") (Var "oy") in
  let x3 := Sub (Var "vz") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  And (And (Less (Mul (Mul (Num 1 10) (Var "weight")) (Add (Max (Max (Abs (Var "vx")) (Abs
    (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz"))) (Num 1 (-960))))) x4) (Finite (Div (Sub (Mul (Sub (Add (Add (Mul (Var "right_x")
    x1) (Mul (Var "right_y") x2)) (Mul (Var "right_z") x3)) (Mul (Var "left") x4)) (Div (Num 1 0)
    (Div (Sub (Var "right") (Var "left")) (Var "width")))) (Mul (Var "dx") x4)) x4))) (Finite (Div
    (Sub (Mul (Sub (Add (Add (Mul (Var "up_x") x1) (Mul (Var "up_y") x2)) (Mul (Var "up_z") x3))
    (Mul (Var "bottom") x4)) (Div (Num 1 0) (Div (Sub (Var "top") (Var "bottom")) (Var "height"))))
    (Mul (Var "dy") x4)) x4)).

(** film.Film.enter, perspective: certain *)
Definition film_perspective_certain : test :=
  let x1 := Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs
    (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))) in
  let x2 := Mul (Num 1 1) (Max (Var "width") (Var "height")) in
  let x3 := Sub (Var "vx") (Var "ox") in
  let x4 := Sub (Var "vy") (Var "oy") in
  let x5 := Sub (Var "vz") (Var "oz") in
  let x6 := Add (Add (Mul (Var "depth_x") x3) (Mul (Var "depth_y") x4)) (Mul (Var "depth_z") x5) in
  And (LessEq (Mul (Num 4548635623644201 (-52)) (Div (Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul
    (Mul x2 (Var "weight")) x1)) x6)) (Num 1 (-26))) (And (And (Less (Mul (Mul (Num 1 10)
    (Var "weight")) x1) x6) (LessEq (Max (Abs (Div (Sub (Mul (Sub (Add (Add (Mul (Var "right_x") x3)
    (Mul (Var "right_y") x4)) (Mul (Var "right_z") x5)) (Mul (Var "left") x6)) (Div (Num 1 0) (Div
    (Sub (Var "right") (Var "left")) (Var "width")))) (Mul (Var "dx") x6)) x6)) (Abs (Div (Sub (Mul
    (Sub (Add (Add (Mul (Var "up_x") x3) (Mul (Var "up_y") x4)) (Mul (Var "up_z") x5)) (Mul
    (Var "bottom") x6)) (Div (Num 1 0) (Div (Sub (Var "top") (Var "bottom")) (Var "height")))) (Mul
    (Var "dy") x6)) x6))) x2)) (Less x1 (Num 1 900))).

(** film.Film.enter, perspective: finite *)
Definition film_perspective_finite : test :=
  Finite (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))).

(** film.Film.enter, perspective: lowest x *)
Definition film_perspective_lowest_x : expr :=
  let x1 := Sub (Var "vx") (Var "ox") in
  let x2 := Sub (Var "vy") (Var "oy") in
  let x3 := Sub (Var "vz") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  let x5 := Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs
    (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))) in
  Min (Max (Ceil (Sub (Div (Sub (Mul (Sub (Add (Add (Mul (Var "right_x") x1) (Mul (Var "right_y")
    x2)) (Mul (Var "right_z") x3)) (Mul (Var "left") x4)) (Div (Num 1 0) (Div (Sub (Var "right")
    (Var "left")) (Var "width")))) (Mul (Var "dx") x4)) x4) (Add (Mul (Num 4548635623644201 (-52))
    (Div (Add (Add (Var "c0") (Mul (Var "c1") x5)) (Mul (Mul (Mul (Num 1 1) (Max (Var "width")
    (Var "height"))) (Var "weight")) x5)) x4)) (Num 1 (-1))))) (Num (-1) 1)) (Add (Var "width")
    (Num 1 1)).

(** film.Film.enter, perspective: lowest y *)
Definition film_perspective_lowest_y : expr :=
  let x1 := Sub (Var "vx") (Var "ox") in
  let x2 := Sub (Var "vy") (Var "oy") in
  let x3 := Sub (Var "vz") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  let x5 := Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs
    (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))) in
  Min (Max (Ceil (Sub (Div (Sub (Mul (Sub (Add (Add (Mul (Var "up_x") x1) (Mul (Var "up_y") x2))
    (Mul (Var "up_z") x3)) (Mul (Var "bottom") x4)) (Div (Num 1 0) (Div (Sub (Var "top")
    (Var "bottom")) (Var "height")))) (Mul (Var "dy") x4)) x4) (Add (Mul
    (Num 4548635623644201 (-52)) (Div (Add (Add (Var "c0") (Mul (Var "c1") x5)) (Mul (Mul (Mul
    (Num 1 1) (Max (Var "width") (Var "height"))) (Var "weight")) x5)) x4)) (Num 1 (-1)))))
    (Num (-1) 1)) (Add (Var "height") (Num 1 1)).

(** film.Film.enter, perspective: minus highest x *)
Definition film_perspective_minus_highest_x : expr :=
  let x1 := Sub (Var "vx") (Var "ox") in
  let x2 := Sub (Var "vy") (Var "oy") in
  let x3 := Sub (Var "vz") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  let x5 := Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs
    (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))) in
  Min (Max (Sub (Num 1 0) (Floor (Add (Div (Sub (Mul (Sub (Add (Add (Mul (Var "right_x") x1) (Mul
    (Var "right_y") x2)) (Mul (Var "right_z") x3)) (Mul (Var "left") x4)) (Div (Num 1 0) (Div (Sub
    (Var "right") (Var "left")) (Var "width")))) (Mul (Var "dx") x4)) x4) (Add (Mul
    (Num 4548635623644201 (-52)) (Div (Add (Add (Var "c0") (Mul (Var "c1") x5)) (Mul (Mul (Mul
    (Num 1 1) (Max (Var "width") (Var "height"))) (Var "weight")) x5)) x4)) (Num 1 (-1)))))) (Sub
    (Neg (Var "width")) (Num 1 1))) (Num 1 1).

(** film.Film.enter, perspective: minus highest y *)
Definition film_perspective_minus_highest_y : expr :=
  let x1 := Sub (Var "vx") (Var "ox") in
  let x2 := Sub (Var "vy") (Var "oy") in
  let x3 := Sub (Var "vz") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  let x5 := Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs
    (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))) in
  Min (Max (Sub (Num 1 0) (Floor (Add (Div (Sub (Mul (Sub (Add (Add (Mul (Var "up_x") x1) (Mul
    (Var "up_y") x2)) (Mul (Var "up_z") x3)) (Mul (Var "bottom") x4)) (Div (Num 1 0) (Div (Sub
    (Var "top") (Var "bottom")) (Var "height")))) (Mul (Var "dy") x4)) x4) (Add (Mul
    (Num 4548635623644201 (-52)) (Div (Add (Add (Var "c0") (Mul (Var "c1") x5)) (Mul (Mul (Mul
    (Num 1 1) (Max (Var "width") (Var "height"))) (Var "weight")) x5)) x4)) (Num 1 (-1)))))) (Sub
    (Neg (Var "height")) (Num 1 1))) (Num 1 1).

(** film.Film.enter, perspective: margin *)
Definition film_perspective_margin : expr :=
  let x1 := Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs
    (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))) in
  Add (Mul (Num 4548635623644201 (-52)) (Div (Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Mul
    (Mul (Num 1 1) (Max (Var "width") (Var "height"))) (Var "weight")) x1)) (Add (Add (Mul
    (Var "depth_x") (Sub (Var "vx") (Var "ox"))) (Mul (Var "depth_y") (Sub (Var "vy") (Var "oy"))))
    (Mul (Var "depth_z") (Sub (Var "vz") (Var "oz")))))) (Num 1 (-1)).

(** film.Film.ray_error, perspective *)
Definition film_ray_error_perspective : expr :=
  Mul (Mul (Num 3 (-49)) (Var "spread")) (Mul (Max (Max (Max (Max (Max (Max (Max (Max (Abs
    (Var "rx")) (Abs (Var "ry"))) (Abs (Var "rz"))) (Abs (Var "ux"))) (Abs (Var "uy"))) (Abs
    (Var "uz"))) (Abs (Var "fx"))) (Abs (Var "fy"))) (Abs (Var "fz"))) (Add (Num 1 0) (Add (Max (Abs
    (Var "left")) (Abs (Var "right"))) (Max (Abs (Var "bottom")) (Abs (Var "top")))))).

(** film.Film.place, perspective: constant *)
Definition film_place_perspective_constant : expr :=
  Num 0 0.

(** film.Film.place, perspective: slope *)
Definition film_place_perspective_slope : expr :=
  let x1 := Abs (Var "left") in
  let x2 := Div (Sub (Var "right") (Var "left")) (Var "width") in
  let x3 := Mul (Num 1 1) (Var "ray_error") in
  let x4 := Abs (Var "bottom") in
  let x5 := Div (Sub (Var "top") (Var "bottom")) (Var "height") in
  Max (Max (Num 0 0) (Mul (Var "spread") (Add (Add (Div (Mul (Num 9 (-49)) (Add (Num 1 0) x1)) x2)
    (Mul (Num 1 (-46)) (Add (Add (Abs (Div (Var "left") x2)) (Var "width")) (Var "height")))) (Div
    (Mul x3 (Add (Num 1 0) (Max x1 (Abs (Var "right"))))) x2)))) (Mul (Var "spread") (Add (Add (Div
    (Mul (Num 9 (-49)) (Add (Num 1 0) x4)) x5) (Mul (Num 1 (-46)) (Add (Add (Abs (Div (Var "bottom")
    x5)) (Var "width")) (Var "height")))) (Div (Mul x3 (Add (Num 1 0) (Max x4 (Abs (Var "top")))))
    x5))).

(** film.Film.certain_error, perspective *)
Definition film_certain_error_perspective : expr :=
  Mul (Add (Add (Div (Num 1 (-25)) (Max (Var "width") (Var "height"))) (Mul (Num 1 1)
    (Var "ray_error"))) (Num 1 (-50))) (Var "nearness").

(** film.Film.certain_nearness, perspective *)
Definition film_certain_nearness_perspective : expr :=
  Div (Num 1 0) (Var "depth").

(** film.Film.enter, orthographic: p *)
Definition film_parallel_p : expr :=
  Sub (Mul (Sub (Add (Add (Mul (Var "right_x") (Sub (Var "vx") (Var "ox"))) (Mul (Var "right_y")
    (Sub (Var "vy") (Var "oy")))) (Mul (Var "right_z") (Sub (Var "vz") (Var "oz")))) (Mul
    (Var "left") (Num 1 0))) (Div (Num 1 0) (Div (Sub (Var "right") (Var "left")) (Var "width"))))
    (Mul (Var "dx") (Num 1 0)).

(** film.Film.enter, orthographic: q *)
Definition film_parallel_q : expr :=
  Sub (Mul (Sub (Add (Add (Mul (Var "up_x") (Sub (Var "vx") (Var "ox"))) (Mul (Var "up_y") (Sub
    (Var "vy") (Var "oy")))) (Mul (Var "up_z") (Sub (Var "vz") (Var "oz")))) (Mul (Var "bottom")
    (Num 1 0))) (Div (Num 1 0) (Div (Sub (Var "top") (Var "bottom")) (Var "height")))) (Mul
    (Var "dy") (Num 1 0)).

(** film.Film.enter, orthographic: w *)
Definition film_parallel_w : expr :=
  Num 1 0.

(** film.Film.enter, orthographic: depth *)
Definition film_parallel_depth : expr :=
  Add (Add (Mul (Var "depth_x") (Sub (Var "vx") (Var "ox"))) (Mul (Var "depth_y") (Sub (Var "vy")
    (Var "oy")))) (Mul (Var "depth_z") (Sub (Var "vz") (Var "oz"))).

(** film.Film.enter, orthographic: size *)
Definition film_parallel_size : expr :=
  Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs (Var "ox"))
    (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))).

(** film.Film.enter, orthographic: x *)
Definition film_parallel_x : expr :=
  Div (Sub (Mul (Sub (Add (Add (Mul (Var "right_x") (Sub (Var "vx") (Var "ox"))) (Mul
    (Var "right_y") (Sub (Var "vy") (Var "oy")))) (Mul (Var "right_z") (Sub (Var "vz") (Var "oz"))))
    (Mul (Var "left") (Num 1 0))) (Div (Num 1 0) (Div (Sub (Var "right") (Var "left"))
    (Var "width")))) (Mul (Var "dx") (Num 1 0))) (Num 1 0).

(** film.Film.enter, orthographic: y *)
Definition film_parallel_y : expr :=
  Div (Sub (Mul (Sub (Add (Add (Mul (Var "up_x") (Sub (Var "vx") (Var "ox"))) (Mul (Var "up_y") (Sub
    (Var "vy") (Var "oy")))) (Mul (Var "up_z") (Sub (Var "vz") (Var "oz")))) (Mul (Var "bottom")
    (Num 1 0))) (Div (Num 1 0) (Div (Sub (Var "top") (Var "bottom")) (Var "height")))) (Mul
    (Var "dy") (Num 1 0))) (Num 1 0).

(** film.Film.enter, orthographic: nearest *)
Definition film_parallel_nearest : expr :=
  Sub (Add (Var "d0") (Mul (Var "d1") (Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs
    (Var "vz"))) (Add (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz")))
    (Num 1 (-960)))))) (Add (Add (Mul (Var "depth_x") (Sub (Var "vx") (Var "ox"))) (Mul
    (Var "depth_y") (Sub (Var "vy") (Var "oy")))) (Mul (Var "depth_z") (Sub (Var "vz") (Var "oz")))).

(** film.Film.enter, orthographic: ahead *)
Definition film_parallel_ahead : test :=
  let x1 := Sub (Var "vx") (Var "ox") in
  let x2 := Sub (Var "vy") (Var "oy") in
  let x3 := Sub (Var "vz") (Var "oz") in
  And (And (Less (Mul (Num 0 0) (Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz")))
    (Add (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))))) (Num 1 0))
    (Finite (Div (Sub (Mul (Sub (Add (Add (Mul (Var "right_x") x1) (Mul (Var "right_y") x2)) (Mul
    (Var "right_z") x3)) (Mul (Var "left") (Num 1 0))) (Div (Num 1 0) (Div (Sub (Var "right")
    (Var "left")) (Var "width")))) (Mul (Var "dx") (Num 1 0))) (Num 1 0)))) (Finite (Div (Sub (Mul
    (Sub (Add (Add (Mul (Var "up_x") x1) (Mul (Var "up_y") x2)) (Mul (Var "up_z") x3)) (Mul
    (Var "bottom") (Num 1 0))) (Div (Num 1 0) (Div (Sub (Var "top") (Var "bottom"))
    (Var "height")))) (Mul (Var "dy") (Num 1 0))) (Num 1 0))).

(** film.Film.enter, orthographic: certain *)
Definition film_parallel_certain : test :=
  let x1 := Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs
    (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))) in
  let x2 := Mul (Num 1 1) (Max (Var "width") (Var "height")) in
  let x3 := Sub (Var "vx") (Var "ox") in
  let x4 := Sub (Var "vy") (Var "oy") in
  let x5 := Sub (Var "vz") (Var "oz") in
  And (LessEq (Mul (Num 4548635623644201 (-52)) (Div (Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul
    (Mul x2 (Num 0 0)) x1)) (Num 1 0))) (Num 1 (-26))) (And (And (Less (Mul (Num 0 0) x1) (Num 1 0))
    (LessEq (Max (Abs (Div (Sub (Mul (Sub (Add (Add (Mul (Var "right_x") x3) (Mul (Var "right_y")
    x4)) (Mul (Var "right_z") x5)) (Mul (Var "left") (Num 1 0))) (Div (Num 1 0) (Div (Sub
    (Var "right") (Var "left")) (Var "width")))) (Mul (Var "dx") (Num 1 0))) (Num 1 0))) (Abs (Div
    (Sub (Mul (Sub (Add (Add (Mul (Var "up_x") x3) (Mul (Var "up_y") x4)) (Mul (Var "up_z") x5))
    (Mul (Var "bottom") (Num 1 0))) (Div (Num 1 0) (Div (Sub (Var "top") (Var "bottom"))
    (Var "height")))) (Mul (Var "dy") (Num 1 0))) (Num 1 0)))) x2)) (Less x1 (Num 1 900))).

(** film.Film.enter, orthographic: finite *)
Definition film_parallel_finite : test :=
  Finite (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))).

(** film.Film.enter, orthographic: lowest x *)
Definition film_parallel_lowest_x : expr :=
  let x1 := Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs
    (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))) in
  Min (Max (Ceil (Sub (Div (Sub (Mul (Sub (Add (Add (Mul (Var "right_x") (Sub (Var "vx")
    (Var "ox"))) (Mul (Var "right_y") (Sub (Var "vy") (Var "oy")))) (Mul (Var "right_z") (Sub
    (Var "vz") (Var "oz")))) (Mul (Var "left") (Num 1 0))) (Div (Num 1 0) (Div (Sub (Var "right")
    (Var "left")) (Var "width")))) (Mul (Var "dx") (Num 1 0))) (Num 1 0)) (Add (Mul
    (Num 4548635623644201 (-52)) (Div (Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Mul (Mul
    (Num 1 1) (Max (Var "width") (Var "height"))) (Num 0 0)) x1)) (Num 1 0))) (Num 1 (-1)))))
    (Num (-1) 1)) (Add (Var "width") (Num 1 1)).

(** film.Film.enter, orthographic: lowest y *)
Definition film_parallel_lowest_y : expr :=
  let x1 := Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs
    (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))) in
  Min (Max (Ceil (Sub (Div (Sub (Mul (Sub (Add (Add (Mul (Var "up_x") (Sub (Var "vx") (Var "ox")))
    (Mul (Var "up_y") (Sub (Var "vy") (Var "oy")))) (Mul (Var "up_z") (Sub (Var "vz") (Var "oz"))))
    (Mul (Var "bottom") (Num 1 0))) (Div (Num 1 0) (Div (Sub (Var "top") (Var "bottom"))
    (Var "height")))) (Mul (Var "dy") (Num 1 0))) (Num 1 0)) (Add (Mul (Num 4548635623644201 (-52))
    (Div (Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Mul (Mul (Num 1 1) (Max (Var "width")
    (Var "height"))) (Num 0 0)) x1)) (Num 1 0))) (Num 1 (-1))))) (Num (-1) 1)) (Add (Var "height")
    (Num 1 1)).

(** film.Film.enter, orthographic: minus highest x *)
Definition film_parallel_minus_highest_x : expr :=
  let x1 := Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs
    (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))) in
  Min (Max (Sub (Num 1 0) (Floor (Add (Div (Sub (Mul (Sub (Add (Add (Mul (Var "right_x") (Sub
    (Var "vx") (Var "ox"))) (Mul (Var "right_y") (Sub (Var "vy") (Var "oy")))) (Mul (Var "right_z")
    (Sub (Var "vz") (Var "oz")))) (Mul (Var "left") (Num 1 0))) (Div (Num 1 0) (Div (Sub
    (Var "right") (Var "left")) (Var "width")))) (Mul (Var "dx") (Num 1 0))) (Num 1 0)) (Add (Mul
    (Num 4548635623644201 (-52)) (Div (Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Mul (Mul
    (Num 1 1) (Max (Var "width") (Var "height"))) (Num 0 0)) x1)) (Num 1 0))) (Num 1 (-1)))))) (Sub
    (Neg (Var "width")) (Num 1 1))) (Num 1 1).

(** film.Film.enter, orthographic: minus highest y *)
Definition film_parallel_minus_highest_y : expr :=
  let x1 := Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs
    (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))) in
  Min (Max (Sub (Num 1 0) (Floor (Add (Div (Sub (Mul (Sub (Add (Add (Mul (Var "up_x") (Sub
    (Var "vx") (Var "ox"))) (Mul (Var "up_y") (Sub (Var "vy") (Var "oy")))) (Mul (Var "up_z") (Sub
    (Var "vz") (Var "oz")))) (Mul (Var "bottom") (Num 1 0))) (Div (Num 1 0) (Div (Sub (Var "top")
    (Var "bottom")) (Var "height")))) (Mul (Var "dy") (Num 1 0))) (Num 1 0)) (Add (Mul
    (Num 4548635623644201 (-52)) (Div (Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Mul (Mul
    (Num 1 1) (Max (Var "width") (Var "height"))) (Num 0 0)) x1)) (Num 1 0))) (Num 1 (-1)))))) (Sub
    (Neg (Var "height")) (Num 1 1))) (Num 1 1).

(** film.Film.enter, orthographic: margin *)
Definition film_parallel_margin : expr :=
  let x1 := Add (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))) (Add (Max (Max (Abs
    (Var "ox")) (Abs (Var "oy"))) (Abs (Var "oz"))) (Num 1 (-960))) in
  Add (Mul (Num 4548635623644201 (-52)) (Div (Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Mul
    (Mul (Num 1 1) (Max (Var "width") (Var "height"))) (Num 0 0)) x1)) (Num 1 0))) (Num 1 (-1)).

(** film.Film.ray_error, orthographic *)
Definition film_ray_error_parallel : expr :=
  Mul (Mul (Num 3 (-49)) (Var "spread")) (Add (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz"))) (Mul (Max (Max (Max (Max (Max (Max (Max (Max (Abs (Var "rx")) (Abs (Var "ry")))
    (Abs (Var "rz"))) (Abs (Var "ux"))) (Abs (Var "uy"))) (Abs (Var "uz"))) (Abs (Var "fx"))) (Abs
    (Var "fy"))) (Abs (Var "fz"))) (Add (Max (Abs (Var "left")) (Abs (Var "right"))) (Max (Abs
    (Var "bottom")) (Abs (Var "top")))))).

(** film.Film.place, orthographic: constant *)
Definition film_place_parallel_constant : expr :=
  let x1 := Div (Sub (Var "right") (Var "left")) (Var "width") in
  let x2 := Mul (Num 1 1) (Var "ray_error") in
  let x3 := Div (Sub (Var "top") (Var "bottom")) (Var "height") in
  Max (Max (Num 0 0) (Add (Mul (Num 1 (-46)) (Add (Add (Abs (Div (Var "left") x1)) (Var "width"))
    (Var "height"))) (Div x2 x1))) (Add (Mul (Num 1 (-46)) (Add (Add (Abs (Div (Var "bottom") x3))
    (Var "width")) (Var "height"))) (Div x2 x3)).

(** film.Film.place, orthographic: slope *)
Definition film_place_parallel_slope : expr :=
  let x1 := Mul (Num 9 (-49)) (Var "spread") in
  Max (Max (Num 0 0) (Div x1 (Div (Sub (Var "right") (Var "left")) (Var "width")))) (Div x1 (Div
    (Sub (Var "top") (Var "bottom")) (Var "height"))).

(** film.Film.certain_error, orthographic *)
Definition film_certain_error_parallel : expr :=
  Add (Var "d0") (Mul (Var "d1") (Div (Num 1 (-25)) (Var "c1"))).

(** film.Film.certain_nearness, orthographic *)
Definition film_certain_nearness_parallel : expr :=
  Neg (Var "depth").

(** film.Film._spread *)
Definition film_spread : expr :=
  Add (Add (Add (Add (Abs (Var "right_x")) (Abs (Var "right_y"))) (Add (Abs (Var "right_z")) (Abs
    (Var "up_x")))) (Add (Add (Abs (Var "up_y")) (Abs (Var "up_z"))) (Add (Abs (Var "depth_x")) (Abs
    (Var "depth_y"))))) (Abs (Var "depth_z")).

(** film.Film.weight *)
Definition film_weight : expr :=
  Mul (Num 1 (-46)) (Var "spread").

(** film.Film.depth_error: constant *)
Definition film_depth_error_constant : expr :=
  Mul (Num 1 1) (Var "ray_error").

(** film.Film.depth_error: slope *)
Definition film_depth_error_slope : expr :=
  Mul (Num 1 (-46)) (Var "spread").

(** camera.camera_rays, perspective: origin x *)
Definition ray_perspective_origin_x : expr :=
  Var "ox".

(** camera.camera_rays, perspective: origin y *)
Definition ray_perspective_origin_y : expr :=
  Var "oy".

(** camera.camera_rays, perspective: origin z *)
Definition ray_perspective_origin_z : expr :=
  Var "oz".

(** camera.camera_rays, perspective: direction x *)
Definition ray_perspective_direction_x : expr :=
  Add (Add (Mul (Add (Var "left") (Mul (Var "px") (Div (Sub (Var "right") (Var "left"))
    (Var "width")))) (Var "rx")) (Mul (Add (Var "bottom") (Mul (Var "py") (Div (Sub (Var "top")
    (Var "bottom")) (Var "height")))) (Var "ux"))) (Var "fx").

(** camera.camera_rays, perspective: direction y *)
Definition ray_perspective_direction_y : expr :=
  Add (Add (Mul (Add (Var "left") (Mul (Var "px") (Div (Sub (Var "right") (Var "left"))
    (Var "width")))) (Var "ry")) (Mul (Add (Var "bottom") (Mul (Var "py") (Div (Sub (Var "top")
    (Var "bottom")) (Var "height")))) (Var "uy"))) (Var "fy").

(** camera.camera_rays, perspective: direction z *)
Definition ray_perspective_direction_z : expr :=
  Add (Add (Mul (Add (Var "left") (Mul (Var "px") (Div (Sub (Var "right") (Var "left"))
    (Var "width")))) (Var "rz")) (Mul (Add (Var "bottom") (Mul (Var "py") (Div (Sub (Var "top")
    (Var "bottom")) (Var "height")))) (Var "uz"))) (Var "fz").

(** camera.camera_rays, orthographic: origin x *)
Definition ray_parallel_origin_x : expr :=
  Add (Var "ox") (Add (Mul (Add (Var "left") (Mul (Var "px") (Div (Sub (Var "right") (Var "left"))
    (Var "width")))) (Var "rx")) (Mul (Add (Var "bottom") (Mul (Var "py") (Div (Sub (Var "top")
    (Var "bottom")) (Var "height")))) (Var "ux"))).

(** camera.camera_rays, orthographic: origin y *)
Definition ray_parallel_origin_y : expr :=
  Add (Var "oy") (Add (Mul (Add (Var "left") (Mul (Var "px") (Div (Sub (Var "right") (Var "left"))
    (Var "width")))) (Var "ry")) (Mul (Add (Var "bottom") (Mul (Var "py") (Div (Sub (Var "top")
    (Var "bottom")) (Var "height")))) (Var "uy"))).

(** camera.camera_rays, orthographic: origin z *)
Definition ray_parallel_origin_z : expr :=
  Add (Var "oz") (Add (Mul (Add (Var "left") (Mul (Var "px") (Div (Sub (Var "right") (Var "left"))
    (Var "width")))) (Var "rz")) (Mul (Add (Var "bottom") (Mul (Var "py") (Div (Sub (Var "top")
    (Var "bottom")) (Var "height")))) (Var "uz"))).

(** camera.camera_rays, orthographic: direction x *)
Definition ray_parallel_direction_x : expr :=
  Var "fx".

(** camera.camera_rays, orthographic: direction y *)
Definition ray_parallel_direction_y : expr :=
  Var "fy".

(** camera.camera_rays, orthographic: direction z *)
Definition ray_parallel_direction_z : expr :=
  Var "fz".

(** camera.film_positions: x *)
Definition film_position_x : expr :=
  Add (Add (Add (Num 0 0) (Var "region_x")) (Num 1 (-1))) (Var "dx").

(** camera.film_positions: y *)
Definition film_position_y : expr :=
  Add (Add (Add (Num 0 0) (Var "region_y")) (Num 1 (-1))) (Var "dy").

(** camera.dual_axes: right x *)
Definition dual_right_x : expr :=
  let x1 := Sub (Mul (Var "uy") (Var "fz")) (Mul (Var "uz") (Var "fy")) in
  Div x1 (Add (Add (Mul (Var "rx") x1) (Mul (Var "ry") (Sub (Mul (Var "uz") (Var "fx")) (Mul
    (Var "ux") (Var "fz"))))) (Mul (Var "rz") (Sub (Mul (Var "ux") (Var "fy")) (Mul (Var "uy")
    (Var "fx"))))).

(** camera.dual_axes: right y *)
Definition dual_right_y : expr :=
  let x1 := Sub (Mul (Var "uz") (Var "fx")) (Mul (Var "ux") (Var "fz")) in
  Div x1 (Add (Add (Mul (Var "rx") (Sub (Mul (Var "uy") (Var "fz")) (Mul (Var "uz") (Var "fy"))))
    (Mul (Var "ry") x1)) (Mul (Var "rz") (Sub (Mul (Var "ux") (Var "fy")) (Mul (Var "uy")
    (Var "fx"))))).

(** camera.dual_axes: right z *)
Definition dual_right_z : expr :=
  let x1 := Sub (Mul (Var "ux") (Var "fy")) (Mul (Var "uy") (Var "fx")) in
  Div x1 (Add (Add (Mul (Var "rx") (Sub (Mul (Var "uy") (Var "fz")) (Mul (Var "uz") (Var "fy"))))
    (Mul (Var "ry") (Sub (Mul (Var "uz") (Var "fx")) (Mul (Var "ux") (Var "fz"))))) (Mul (Var "rz")
    x1)).

(** camera.dual_axes: up x *)
Definition dual_up_x : expr :=
  Div (Sub (Mul (Var "fy") (Var "rz")) (Mul (Var "fz") (Var "ry"))) (Add (Add (Mul (Var "rx") (Sub
    (Mul (Var "uy") (Var "fz")) (Mul (Var "uz") (Var "fy")))) (Mul (Var "ry") (Sub (Mul (Var "uz")
    (Var "fx")) (Mul (Var "ux") (Var "fz"))))) (Mul (Var "rz") (Sub (Mul (Var "ux") (Var "fy")) (Mul
    (Var "uy") (Var "fx"))))).

(** camera.dual_axes: up y *)
Definition dual_up_y : expr :=
  Div (Sub (Mul (Var "fz") (Var "rx")) (Mul (Var "fx") (Var "rz"))) (Add (Add (Mul (Var "rx") (Sub
    (Mul (Var "uy") (Var "fz")) (Mul (Var "uz") (Var "fy")))) (Mul (Var "ry") (Sub (Mul (Var "uz")
    (Var "fx")) (Mul (Var "ux") (Var "fz"))))) (Mul (Var "rz") (Sub (Mul (Var "ux") (Var "fy")) (Mul
    (Var "uy") (Var "fx"))))).

(** camera.dual_axes: up z *)
Definition dual_up_z : expr :=
  Div (Sub (Mul (Var "fx") (Var "ry")) (Mul (Var "fy") (Var "rx"))) (Add (Add (Mul (Var "rx") (Sub
    (Mul (Var "uy") (Var "fz")) (Mul (Var "uz") (Var "fy")))) (Mul (Var "ry") (Sub (Mul (Var "uz")
    (Var "fx")) (Mul (Var "ux") (Var "fz"))))) (Mul (Var "rz") (Sub (Mul (Var "ux") (Var "fy")) (Mul
    (Var "uy") (Var "fx"))))).

(** camera.dual_axes: depth x *)
Definition dual_depth_x : expr :=
  Div (Sub (Mul (Var "ry") (Var "uz")) (Mul (Var "rz") (Var "uy"))) (Add (Add (Mul (Var "rx") (Sub
    (Mul (Var "uy") (Var "fz")) (Mul (Var "uz") (Var "fy")))) (Mul (Var "ry") (Sub (Mul (Var "uz")
    (Var "fx")) (Mul (Var "ux") (Var "fz"))))) (Mul (Var "rz") (Sub (Mul (Var "ux") (Var "fy")) (Mul
    (Var "uy") (Var "fx"))))).

(** camera.dual_axes: depth y *)
Definition dual_depth_y : expr :=
  Div (Sub (Mul (Var "rz") (Var "ux")) (Mul (Var "rx") (Var "uz"))) (Add (Add (Mul (Var "rx") (Sub
    (Mul (Var "uy") (Var "fz")) (Mul (Var "uz") (Var "fy")))) (Mul (Var "ry") (Sub (Mul (Var "uz")
    (Var "fx")) (Mul (Var "ux") (Var "fz"))))) (Mul (Var "rz") (Sub (Mul (Var "ux") (Var "fy")) (Mul
    (Var "uy") (Var "fx"))))).

(** camera.dual_axes: depth z *)
Definition dual_depth_z : expr :=
  Div (Sub (Mul (Var "rx") (Var "uy")) (Mul (Var "ry") (Var "ux"))) (Add (Add (Mul (Var "rx") (Sub
    (Mul (Var "uy") (Var "fz")) (Mul (Var "uz") (Var "fy")))) (Mul (Var "ry") (Sub (Mul (Var "uz")
    (Var "fx")) (Mul (Var "ux") (Var "fz"))))) (Mul (Var "rz") (Sub (Mul (Var "ux") (Var "fy")) (Mul
    (Var "uy") (Var "fx"))))).

(** camera.project: right *)
Definition project_right : expr :=
  Add (Add (Mul (Var "right_x") (Sub (Var "vx") (Var "ox"))) (Mul (Var "right_y") (Sub (Var "vy")
    (Var "oy")))) (Mul (Var "right_z") (Sub (Var "vz") (Var "oz"))).

(** camera.project: up *)
Definition project_up : expr :=
  Add (Add (Mul (Var "up_x") (Sub (Var "vx") (Var "ox"))) (Mul (Var "up_y") (Sub (Var "vy")
    (Var "oy")))) (Mul (Var "up_z") (Sub (Var "vz") (Var "oz"))).

(** camera.project: depth *)
Definition project_depth : expr :=
  Add (Add (Mul (Var "depth_x") (Sub (Var "vx") (Var "ox"))) (Mul (Var "depth_y") (Sub (Var "vy")
    (Var "oy")))) (Mul (Var "depth_z") (Sub (Var "vz") (Var "oz"))).

(** camera.project: magnitude right *)
Definition project_magnitude_right : expr :=
  Add (Add (Mul (Abs (Var "right_x")) (Add (Abs (Var "vx")) (Abs (Var "ox")))) (Mul (Abs
    (Var "right_y")) (Add (Abs (Var "vy")) (Abs (Var "oy"))))) (Mul (Abs (Var "right_z")) (Add (Abs
    (Var "vz")) (Abs (Var "oz")))).

(** camera.project: magnitude up *)
Definition project_magnitude_up : expr :=
  Add (Add (Mul (Abs (Var "up_x")) (Add (Abs (Var "vx")) (Abs (Var "ox")))) (Mul (Abs (Var "up_y"))
    (Add (Abs (Var "vy")) (Abs (Var "oy"))))) (Mul (Abs (Var "up_z")) (Add (Abs (Var "vz")) (Abs
    (Var "oz")))).

(** camera.project: magnitude depth *)
Definition project_magnitude_depth : expr :=
  Add (Add (Mul (Abs (Var "depth_x")) (Add (Abs (Var "vx")) (Abs (Var "ox")))) (Mul (Abs
    (Var "depth_y")) (Add (Abs (Var "vy")) (Abs (Var "oy"))))) (Mul (Abs (Var "depth_z")) (Add (Abs
    (Var "vz")) (Abs (Var "oz")))).

(** candidates.pixel_bounds, perspective: x0 *)
Definition pixel_bounds_perspective_x0 : expr :=
  let x1 := Sub (Var "ax") (Var "ox") in
  let x2 := Sub (Var "ay") (Var "oy") in
  let x3 := Sub (Var "az") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  let x5 := Sub (Var "bx") (Var "ox") in
  let x6 := Sub (Var "by") (Var "oy") in
  let x7 := Sub (Var "bz") (Var "oz") in
  let x8 := Add (Add (Mul (Var "depth_x") x5) (Mul (Var "depth_y") x6)) (Mul (Var "depth_z") x7) in
  let x9 := Sub (Var "cx") (Var "ox") in
  let x10 := Sub (Var "cy") (Var "oy") in
  let x11 := Sub (Var "cz") (Var "oz") in
  let x12 := Add (Add (Mul (Var "depth_x") x9) (Mul (Var "depth_y") x10)) (Mul (Var "depth_z") x11)
    in
  let x13 := Abs (Var "right_x") in
  let x14 := Abs (Var "ox") in
  let x15 := Add (Abs (Var "ax")) x14 in
  let x16 := Abs (Var "right_y") in
  let x17 := Abs (Var "oy") in
  let x18 := Add (Abs (Var "ay")) x17 in
  let x19 := Abs (Var "right_z") in
  let x20 := Abs (Var "oz") in
  let x21 := Add (Abs (Var "az")) x20 in
  let x22 := Abs (Var "up_x") in
  let x23 := Abs (Var "up_y") in
  let x24 := Abs (Var "up_z") in
  let x25 := Abs (Var "depth_x") in
  let x26 := Abs (Var "depth_y") in
  let x27 := Abs (Var "depth_z") in
  let x28 := Add (Abs (Var "bx")) x14 in
  let x29 := Add (Abs (Var "by")) x17 in
  let x30 := Add (Abs (Var "bz")) x20 in
  let x31 := Add (Abs (Var "cx")) x14 in
  let x32 := Add (Abs (Var "cy")) x17 in
  let x33 := Add (Abs (Var "cz")) x20 in
  let x34 := Max (Max (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x13 x15) (Mul x16 x18)) (Mul
    x19 x21)) (Add (Add (Mul x22 x15) (Mul x23 x18)) (Mul x24 x21))) (Add (Add (Mul x25 x15) (Mul
    x26 x18)) (Mul x27 x21)))) (Num 1 (-1000))) (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x13
    x28) (Mul x16 x29)) (Mul x19 x30)) (Add (Add (Mul x22 x28) (Mul x23 x29)) (Mul x24 x30))) (Add
    (Add (Mul x25 x28) (Mul x26 x29)) (Mul x27 x30)))) (Num 1 (-1000)))) (Add (Mul (Num 1 (-46))
    (Add (Add (Add (Add (Mul x13 x31) (Mul x16 x32)) (Mul x19 x33)) (Add (Add (Mul x22 x31) (Mul x23
    x32)) (Mul x24 x33))) (Add (Add (Mul x25 x31) (Mul x26 x32)) (Mul x27 x33)))) (Num 1 (-1000)))
    in
  let x35 := Sub (Min (Min x4 x8) x12) x34 in
  let x36 := Add (Add (Mul (Var "right_x") x1) (Mul (Var "right_y") x2)) (Mul (Var "right_z") x3) in
  let x37 := Div x36 x4 in
  let x38 := Add (Add (Mul (Var "right_x") x5) (Mul (Var "right_y") x6)) (Mul (Var "right_z") x7) in
  let x39 := Div x38 x8 in
  let x40 := Add (Add (Mul (Var "right_x") x9) (Mul (Var "right_y") x10)) (Mul (Var "right_z") x11)
    in
  let x41 := Div x40 x12 in
  let x42 := Sub (Min (Min x36 x38) x40) x34 in
  let x43 := Max x35 (Var "clip_start") in
  let x44 := Div (Sub (Var "right") (Var "left")) (Var "width") in
  let x45 := Ceil (Sub (Sub (Div (Sub (Where (LessEq (Var "clip_start") x35) (Min (Min (Sub x37 (Div
    (Mul x34 (Add (Num 1 0) (Abs x37))) (Sub x4 x34))) (Sub x39 (Div (Mul x34 (Add (Num 1 0) (Abs
    x39))) (Sub x8 x34)))) (Sub x41 (Div (Mul x34 (Add (Num 1 0) (Abs x41))) (Sub x12 x34)))) (Where
    (Less x42 (Num 0 0)) (Div x42 x43) (Div x42 (Max (Add (Max (Max x4 x8) x12) x34) x43))))
    (Var "left")) x44) (Num 1 (-1))) (Add (Var "reach") (Mul (Num 1 (-46)) (Add (Add (Abs (Div
    (Var "left") x44)) (Var "width")) (Var "height"))))) in
  Where (Not (Same x45 x45)) (Var "region_x") (Min (Max x45 (Var "region_x")) (Var "region_x_end")).

(** candidates.pixel_bounds, perspective: x1 *)
Definition pixel_bounds_perspective_x1 : expr :=
  let x1 := Sub (Var "ax") (Var "ox") in
  let x2 := Sub (Var "ay") (Var "oy") in
  let x3 := Sub (Var "az") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  let x5 := Sub (Var "bx") (Var "ox") in
  let x6 := Sub (Var "by") (Var "oy") in
  let x7 := Sub (Var "bz") (Var "oz") in
  let x8 := Add (Add (Mul (Var "depth_x") x5) (Mul (Var "depth_y") x6)) (Mul (Var "depth_z") x7) in
  let x9 := Sub (Var "cx") (Var "ox") in
  let x10 := Sub (Var "cy") (Var "oy") in
  let x11 := Sub (Var "cz") (Var "oz") in
  let x12 := Add (Add (Mul (Var "depth_x") x9) (Mul (Var "depth_y") x10)) (Mul (Var "depth_z") x11)
    in
  let x13 := Abs (Var "right_x") in
  let x14 := Abs (Var "ox") in
  let x15 := Add (Abs (Var "ax")) x14 in
  let x16 := Abs (Var "right_y") in
  let x17 := Abs (Var "oy") in
  let x18 := Add (Abs (Var "ay")) x17 in
  let x19 := Abs (Var "right_z") in
  let x20 := Abs (Var "oz") in
  let x21 := Add (Abs (Var "az")) x20 in
  let x22 := Abs (Var "up_x") in
  let x23 := Abs (Var "up_y") in
  let x24 := Abs (Var "up_z") in
  let x25 := Abs (Var "depth_x") in
  let x26 := Abs (Var "depth_y") in
  let x27 := Abs (Var "depth_z") in
  let x28 := Add (Abs (Var "bx")) x14 in
  let x29 := Add (Abs (Var "by")) x17 in
  let x30 := Add (Abs (Var "bz")) x20 in
  let x31 := Add (Abs (Var "cx")) x14 in
  let x32 := Add (Abs (Var "cy")) x17 in
  let x33 := Add (Abs (Var "cz")) x20 in
  let x34 := Max (Max (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x13 x15) (Mul x16 x18)) (Mul
    x19 x21)) (Add (Add (Mul x22 x15) (Mul x23 x18)) (Mul x24 x21))) (Add (Add (Mul x25 x15) (Mul
    x26 x18)) (Mul x27 x21)))) (Num 1 (-1000))) (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x13
    x28) (Mul x16 x29)) (Mul x19 x30)) (Add (Add (Mul x22 x28) (Mul x23 x29)) (Mul x24 x30))) (Add
    (Add (Mul x25 x28) (Mul x26 x29)) (Mul x27 x30)))) (Num 1 (-1000)))) (Add (Mul (Num 1 (-46))
    (Add (Add (Add (Add (Mul x13 x31) (Mul x16 x32)) (Mul x19 x33)) (Add (Add (Mul x22 x31) (Mul x23
    x32)) (Mul x24 x33))) (Add (Add (Mul x25 x31) (Mul x26 x32)) (Mul x27 x33)))) (Num 1 (-1000)))
    in
  let x35 := Sub (Min (Min x4 x8) x12) x34 in
  let x36 := Add (Add (Mul (Var "right_x") x1) (Mul (Var "right_y") x2)) (Mul (Var "right_z") x3) in
  let x37 := Div x36 x4 in
  let x38 := Add (Add (Mul (Var "right_x") x5) (Mul (Var "right_y") x6)) (Mul (Var "right_z") x7) in
  let x39 := Div x38 x8 in
  let x40 := Add (Add (Mul (Var "right_x") x9) (Mul (Var "right_y") x10)) (Mul (Var "right_z") x11)
    in
  let x41 := Div x40 x12 in
  let x42 := Add (Max (Max x36 x38) x40) x34 in
  let x43 := Max x35 (Var "clip_start") in
  let x44 := Div (Sub (Var "right") (Var "left")) (Var "width") in
  let x45 := Add (Floor (Add (Sub (Div (Sub (Where (LessEq (Var "clip_start") x35) (Max (Max (Add
    x37 (Div (Mul x34 (Add (Num 1 0) (Abs x37))) (Sub x4 x34))) (Add x39 (Div (Mul x34 (Add
    (Num 1 0) (Abs x39))) (Sub x8 x34)))) (Add x41 (Div (Mul x34 (Add (Num 1 0) (Abs x41))) (Sub x12
    x34)))) (Where (Less (Num 0 0) x42) (Div x42 x43) (Div x42 (Max (Add (Max (Max x4 x8) x12) x34)
    x43)))) (Var "left")) x44) (Num 1 (-1))) (Add (Var "reach") (Mul (Num 1 (-46)) (Add (Add (Abs
    (Div (Var "left") x44)) (Var "width")) (Var "height")))))) (Num 1 0) in
  Where (Not (Same x45 x45)) (Var "region_x_end") (Min (Max x45 (Var "region_x"))
    (Var "region_x_end")).

(** candidates.pixel_bounds, perspective: y0 *)
Definition pixel_bounds_perspective_y0 : expr :=
  let x1 := Sub (Var "ax") (Var "ox") in
  let x2 := Sub (Var "ay") (Var "oy") in
  let x3 := Sub (Var "az") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  let x5 := Sub (Var "bx") (Var "ox") in
  let x6 := Sub (Var "by") (Var "oy") in
  let x7 := Sub (Var "bz") (Var "oz") in
  let x8 := Add (Add (Mul (Var "depth_x") x5) (Mul (Var "depth_y") x6)) (Mul (Var "depth_z") x7) in
  let x9 := Sub (Var "cx") (Var "ox") in
  let x10 := Sub (Var "cy") (Var "oy") in
  let x11 := Sub (Var "cz") (Var "oz") in
  let x12 := Add (Add (Mul (Var "depth_x") x9) (Mul (Var "depth_y") x10)) (Mul (Var "depth_z") x11)
    in
  let x13 := Abs (Var "right_x") in
  let x14 := Abs (Var "ox") in
  let x15 := Add (Abs (Var "ax")) x14 in
  let x16 := Abs (Var "right_y") in
  let x17 := Abs (Var "oy") in
  let x18 := Add (Abs (Var "ay")) x17 in
  let x19 := Abs (Var "right_z") in
  let x20 := Abs (Var "oz") in
  let x21 := Add (Abs (Var "az")) x20 in
  let x22 := Abs (Var "up_x") in
  let x23 := Abs (Var "up_y") in
  let x24 := Abs (Var "up_z") in
  let x25 := Abs (Var "depth_x") in
  let x26 := Abs (Var "depth_y") in
  let x27 := Abs (Var "depth_z") in
  let x28 := Add (Abs (Var "bx")) x14 in
  let x29 := Add (Abs (Var "by")) x17 in
  let x30 := Add (Abs (Var "bz")) x20 in
  let x31 := Add (Abs (Var "cx")) x14 in
  let x32 := Add (Abs (Var "cy")) x17 in
  let x33 := Add (Abs (Var "cz")) x20 in
  let x34 := Max (Max (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x13 x15) (Mul x16 x18)) (Mul
    x19 x21)) (Add (Add (Mul x22 x15) (Mul x23 x18)) (Mul x24 x21))) (Add (Add (Mul x25 x15) (Mul
    x26 x18)) (Mul x27 x21)))) (Num 1 (-1000))) (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x13
    x28) (Mul x16 x29)) (Mul x19 x30)) (Add (Add (Mul x22 x28) (Mul x23 x29)) (Mul x24 x30))) (Add
    (Add (Mul x25 x28) (Mul x26 x29)) (Mul x27 x30)))) (Num 1 (-1000)))) (Add (Mul (Num 1 (-46))
    (Add (Add (Add (Add (Mul x13 x31) (Mul x16 x32)) (Mul x19 x33)) (Add (Add (Mul x22 x31) (Mul x23
    x32)) (Mul x24 x33))) (Add (Add (Mul x25 x31) (Mul x26 x32)) (Mul x27 x33)))) (Num 1 (-1000)))
    in
  let x35 := Sub (Min (Min x4 x8) x12) x34 in
  let x36 := Add (Add (Mul (Var "up_x") x1) (Mul (Var "up_y") x2)) (Mul (Var "up_z") x3) in
  let x37 := Div x36 x4 in
  let x38 := Add (Add (Mul (Var "up_x") x5) (Mul (Var "up_y") x6)) (Mul (Var "up_z") x7) in
  let x39 := Div x38 x8 in
  let x40 := Add (Add (Mul (Var "up_x") x9) (Mul (Var "up_y") x10)) (Mul (Var "up_z") x11) in
  let x41 := Div x40 x12 in
  let x42 := Sub (Min (Min x36 x38) x40) x34 in
  let x43 := Max x35 (Var "clip_start") in
  let x44 := Div (Sub (Var "top") (Var "bottom")) (Var "height") in
  let x45 := Ceil (Sub (Sub (Div (Sub (Where (LessEq (Var "clip_start") x35) (Min (Min (Sub x37 (Div
    (Mul x34 (Add (Num 1 0) (Abs x37))) (Sub x4 x34))) (Sub x39 (Div (Mul x34 (Add (Num 1 0) (Abs
    x39))) (Sub x8 x34)))) (Sub x41 (Div (Mul x34 (Add (Num 1 0) (Abs x41))) (Sub x12 x34)))) (Where
    (Less x42 (Num 0 0)) (Div x42 x43) (Div x42 (Max (Add (Max (Max x4 x8) x12) x34) x43))))
    (Var "bottom")) x44) (Num 1 (-1))) (Add (Var "reach") (Mul (Num 1 (-46)) (Add (Add (Abs (Div
    (Var "bottom") x44)) (Var "width")) (Var "height"))))) in
  Where (Not (Same x45 x45)) (Var "region_y") (Min (Max x45 (Var "region_y")) (Var "region_y_end")).

(** candidates.pixel_bounds, perspective: y1 *)
Definition pixel_bounds_perspective_y1 : expr :=
  let x1 := Sub (Var "ax") (Var "ox") in
  let x2 := Sub (Var "ay") (Var "oy") in
  let x3 := Sub (Var "az") (Var "oz") in
  let x4 := Add (Add (Mul (Var "depth_x") x1) (Mul (Var "depth_y") x2)) (Mul (Var "depth_z") x3) in
  let x5 := Sub (Var "bx") (Var "ox") in
  let x6 := Sub (Var "by") (Var "oy") in
  let x7 := Sub (Var "bz") (Var "oz") in
  let x8 := Add (Add (Mul (Var "depth_x") x5) (Mul (Var "depth_y") x6)) (Mul (Var "depth_z") x7) in
  let x9 := Sub (Var "cx") (Var "ox") in
  let x10 := Sub (Var "cy") (Var "oy") in
  let x11 := Sub (Var "cz") (Var "oz") in
  let x12 := Add (Add (Mul (Var "depth_x") x9) (Mul (Var "depth_y") x10)) (Mul (Var "depth_z") x11)
    in
  let x13 := Abs (Var "right_x") in
  let x14 := Abs (Var "ox") in
  let x15 := Add (Abs (Var "ax")) x14 in
  let x16 := Abs (Var "right_y") in
  let x17 := Abs (Var "oy") in
  let x18 := Add (Abs (Var "ay")) x17 in
  let x19 := Abs (Var "right_z") in
  let x20 := Abs (Var "oz") in
  let x21 := Add (Abs (Var "az")) x20 in
  let x22 := Abs (Var "up_x") in
  let x23 := Abs (Var "up_y") in
  let x24 := Abs (Var "up_z") in
  let x25 := Abs (Var "depth_x") in
  let x26 := Abs (Var "depth_y") in
  let x27 := Abs (Var "depth_z") in
  let x28 := Add (Abs (Var "bx")) x14 in
  let x29 := Add (Abs (Var "by")) x17 in
  let x30 := Add (Abs (Var "bz")) x20 in
  let x31 := Add (Abs (Var "cx")) x14 in
  let x32 := Add (Abs (Var "cy")) x17 in
  let x33 := Add (Abs (Var "cz")) x20 in
  let x34 := Max (Max (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x13 x15) (Mul x16 x18)) (Mul
    x19 x21)) (Add (Add (Mul x22 x15) (Mul x23 x18)) (Mul x24 x21))) (Add (Add (Mul x25 x15) (Mul
    x26 x18)) (Mul x27 x21)))) (Num 1 (-1000))) (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x13
    x28) (Mul x16 x29)) (Mul x19 x30)) (Add (Add (Mul x22 x28) (Mul x23 x29)) (Mul x24 x30))) (Add
    (Add (Mul x25 x28) (Mul x26 x29)) (Mul x27 x30)))) (Num 1 (-1000)))) (Add (Mul (Num 1 (-46))
    (Add (Add (Add (Add (Mul x13 x31) (Mul x16 x32)) (Mul x19 x33)) (Add (Add (Mul x22 x31) (Mul x23
    x32)) (Mul x24 x33))) (Add (Add (Mul x25 x31) (Mul x26 x32)) (Mul x27 x33)))) (Num 1 (-1000)))
    in
  let x35 := Sub (Min (Min x4 x8) x12) x34 in
  let x36 := Add (Add (Mul (Var "up_x") x1) (Mul (Var "up_y") x2)) (Mul (Var "up_z") x3) in
  let x37 := Div x36 x4 in
  let x38 := Add (Add (Mul (Var "up_x") x5) (Mul (Var "up_y") x6)) (Mul (Var "up_z") x7) in
  let x39 := Div x38 x8 in
  let x40 := Add (Add (Mul (Var "up_x") x9) (Mul (Var "up_y") x10)) (Mul (Var "up_z") x11) in
  let x41 := Div x40 x12 in
  let x42 := Add (Max (Max x36 x38) x40) x34 in
  let x43 := Max x35 (Var "clip_start") in
  let x44 := Div (Sub (Var "top") (Var "bottom")) (Var "height") in
  let x45 := Add (Floor (Add (Sub (Div (Sub (Where (LessEq (Var "clip_start") x35) (Max (Max (Add
    x37 (Div (Mul x34 (Add (Num 1 0) (Abs x37))) (Sub x4 x34))) (Add x39 (Div (Mul x34 (Add
    (Num 1 0) (Abs x39))) (Sub x8 x34)))) (Add x41 (Div (Mul x34 (Add (Num 1 0) (Abs x41))) (Sub x12
    x34)))) (Where (Less (Num 0 0) x42) (Div x42 x43) (Div x42 (Max (Add (Max (Max x4 x8) x12) x34)
    x43)))) (Var "bottom")) x44) (Num 1 (-1))) (Add (Var "reach") (Mul (Num 1 (-46)) (Add (Add (Abs
    (Div (Var "bottom") x44)) (Var "width")) (Var "height")))))) (Num 1 0) in
  Where (Not (Same x45 x45)) (Var "region_y_end") (Min (Max x45 (Var "region_y"))
    (Var "region_y_end")).

(** candidates.pixel_bounds, perspective: path *)
Definition pixel_bounds_perspective_path : test :=
  let x1 := Add (Add (Mul (Var "depth_x") (Sub (Var "ax") (Var "ox"))) (Mul (Var "depth_y") (Sub
    (Var "ay") (Var "oy")))) (Mul (Var "depth_z") (Sub (Var "az") (Var "oz"))) in
  let x2 := Add (Add (Mul (Var "depth_x") (Sub (Var "bx") (Var "ox"))) (Mul (Var "depth_y") (Sub
    (Var "by") (Var "oy")))) (Mul (Var "depth_z") (Sub (Var "bz") (Var "oz"))) in
  let x3 := Add (Add (Mul (Var "depth_x") (Sub (Var "cx") (Var "ox"))) (Mul (Var "depth_y") (Sub
    (Var "cy") (Var "oy")))) (Mul (Var "depth_z") (Sub (Var "cz") (Var "oz"))) in
  let x4 := Abs (Var "right_x") in
  let x5 := Abs (Var "ox") in
  let x6 := Add (Abs (Var "ax")) x5 in
  let x7 := Abs (Var "right_y") in
  let x8 := Abs (Var "oy") in
  let x9 := Add (Abs (Var "ay")) x8 in
  let x10 := Abs (Var "right_z") in
  let x11 := Abs (Var "oz") in
  let x12 := Add (Abs (Var "az")) x11 in
  let x13 := Abs (Var "up_x") in
  let x14 := Abs (Var "up_y") in
  let x15 := Abs (Var "up_z") in
  let x16 := Abs (Var "depth_x") in
  let x17 := Abs (Var "depth_y") in
  let x18 := Abs (Var "depth_z") in
  let x19 := Add (Abs (Var "bx")) x5 in
  let x20 := Add (Abs (Var "by")) x8 in
  let x21 := Add (Abs (Var "bz")) x11 in
  let x22 := Add (Abs (Var "cx")) x5 in
  let x23 := Add (Abs (Var "cy")) x8 in
  let x24 := Add (Abs (Var "cz")) x11 in
  let x25 := Max (Max (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x4 x6) (Mul x7 x9)) (Mul x10
    x12)) (Add (Add (Mul x13 x6) (Mul x14 x9)) (Mul x15 x12))) (Add (Add (Mul x16 x6) (Mul x17 x9))
    (Mul x18 x12)))) (Num 1 (-1000))) (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x4 x19) (Mul
    x7 x20)) (Mul x10 x21)) (Add (Add (Mul x13 x19) (Mul x14 x20)) (Mul x15 x21))) (Add (Add (Mul
    x16 x19) (Mul x17 x20)) (Mul x18 x21)))) (Num 1 (-1000)))) (Add (Mul (Num 1 (-46)) (Add (Add
    (Add (Add (Mul x4 x22) (Mul x7 x23)) (Mul x10 x24)) (Add (Add (Mul x13 x22) (Mul x14 x23)) (Mul
    x15 x24))) (Add (Add (Mul x16 x22) (Mul x17 x23)) (Mul x18 x24)))) (Num 1 (-1000))) in
  Not (Or (Less (Add (Max (Max x1 x2) x3) x25) (Var "clip_start")) (Less (Var "clip_end") (Sub (Min
    (Min x1 x2) x3) x25))).

(** candidates.pixel_bounds, orthographic: x0 *)
Definition pixel_bounds_parallel_x0 : expr :=
  let x1 := Abs (Var "right_x") in
  let x2 := Abs (Var "ox") in
  let x3 := Add (Abs (Var "ax")) x2 in
  let x4 := Abs (Var "right_y") in
  let x5 := Abs (Var "oy") in
  let x6 := Add (Abs (Var "ay")) x5 in
  let x7 := Abs (Var "right_z") in
  let x8 := Abs (Var "oz") in
  let x9 := Add (Abs (Var "az")) x8 in
  let x10 := Abs (Var "up_x") in
  let x11 := Abs (Var "up_y") in
  let x12 := Abs (Var "up_z") in
  let x13 := Abs (Var "depth_x") in
  let x14 := Abs (Var "depth_y") in
  let x15 := Abs (Var "depth_z") in
  let x16 := Add (Abs (Var "bx")) x2 in
  let x17 := Add (Abs (Var "by")) x5 in
  let x18 := Add (Abs (Var "bz")) x8 in
  let x19 := Add (Abs (Var "cx")) x2 in
  let x20 := Add (Abs (Var "cy")) x5 in
  let x21 := Add (Abs (Var "cz")) x8 in
  let x22 := Div (Sub (Var "right") (Var "left")) (Var "width") in
  let x23 := Ceil (Sub (Sub (Div (Sub (Sub (Min (Min (Add (Add (Mul (Var "right_x") (Sub (Var "ax")
    (Var "ox"))) (Mul (Var "right_y") (Sub (Var "ay") (Var "oy")))) (Mul (Var "right_z") (Sub
    (Var "az") (Var "oz")))) (Add (Add (Mul (Var "right_x") (Sub (Var "bx") (Var "ox"))) (Mul
    (Var "right_y") (Sub (Var "by") (Var "oy")))) (Mul (Var "right_z") (Sub (Var "bz")
    (Var "oz"))))) (Add (Add (Mul (Var "right_x") (Sub (Var "cx") (Var "ox"))) (Mul (Var "right_y")
    (Sub (Var "cy") (Var "oy")))) (Mul (Var "right_z") (Sub (Var "cz") (Var "oz"))))) (Max (Max (Add
    (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x1 x3) (Mul x4 x6)) (Mul x7 x9)) (Add (Add (Mul x10
    x3) (Mul x11 x6)) (Mul x12 x9))) (Add (Add (Mul x13 x3) (Mul x14 x6)) (Mul x15 x9))))
    (Num 1 (-1000))) (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x1 x16) (Mul x4 x17)) (Mul x7
    x18)) (Add (Add (Mul x10 x16) (Mul x11 x17)) (Mul x12 x18))) (Add (Add (Mul x13 x16) (Mul x14
    x17)) (Mul x15 x18)))) (Num 1 (-1000)))) (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x1
    x19) (Mul x4 x20)) (Mul x7 x21)) (Add (Add (Mul x10 x19) (Mul x11 x20)) (Mul x12 x21))) (Add
    (Add (Mul x13 x19) (Mul x14 x20)) (Mul x15 x21)))) (Num 1 (-1000))))) (Var "left")) x22)
    (Num 1 (-1))) (Add (Var "reach") (Mul (Num 1 (-46)) (Add (Add (Abs (Div (Var "left") x22))
    (Var "width")) (Var "height"))))) in
  Where (Not (Same x23 x23)) (Var "region_x") (Min (Max x23 (Var "region_x")) (Var "region_x_end")).

(** candidates.pixel_bounds, orthographic: x1 *)
Definition pixel_bounds_parallel_x1 : expr :=
  let x1 := Abs (Var "right_x") in
  let x2 := Abs (Var "ox") in
  let x3 := Add (Abs (Var "ax")) x2 in
  let x4 := Abs (Var "right_y") in
  let x5 := Abs (Var "oy") in
  let x6 := Add (Abs (Var "ay")) x5 in
  let x7 := Abs (Var "right_z") in
  let x8 := Abs (Var "oz") in
  let x9 := Add (Abs (Var "az")) x8 in
  let x10 := Abs (Var "up_x") in
  let x11 := Abs (Var "up_y") in
  let x12 := Abs (Var "up_z") in
  let x13 := Abs (Var "depth_x") in
  let x14 := Abs (Var "depth_y") in
  let x15 := Abs (Var "depth_z") in
  let x16 := Add (Abs (Var "bx")) x2 in
  let x17 := Add (Abs (Var "by")) x5 in
  let x18 := Add (Abs (Var "bz")) x8 in
  let x19 := Add (Abs (Var "cx")) x2 in
  let x20 := Add (Abs (Var "cy")) x5 in
  let x21 := Add (Abs (Var "cz")) x8 in
  let x22 := Div (Sub (Var "right") (Var "left")) (Var "width") in
  let x23 := Add (Floor (Add (Sub (Div (Sub (Add (Max (Max (Add (Add (Mul (Var "right_x") (Sub
    (Var "ax") (Var "ox"))) (Mul (Var "right_y") (Sub (Var "ay") (Var "oy")))) (Mul (Var "right_z")
    (Sub (Var "az") (Var "oz")))) (Add (Add (Mul (Var "right_x") (Sub (Var "bx") (Var "ox"))) (Mul
    (Var "right_y") (Sub (Var "by") (Var "oy")))) (Mul (Var "right_z") (Sub (Var "bz")
    (Var "oz"))))) (Add (Add (Mul (Var "right_x") (Sub (Var "cx") (Var "ox"))) (Mul (Var "right_y")
    (Sub (Var "cy") (Var "oy")))) (Mul (Var "right_z") (Sub (Var "cz") (Var "oz"))))) (Max (Max (Add
    (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x1 x3) (Mul x4 x6)) (Mul x7 x9)) (Add (Add (Mul x10
    x3) (Mul x11 x6)) (Mul x12 x9))) (Add (Add (Mul x13 x3) (Mul x14 x6)) (Mul x15 x9))))
    (Num 1 (-1000))) (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x1 x16) (Mul x4 x17)) (Mul x7
    x18)) (Add (Add (Mul x10 x16) (Mul x11 x17)) (Mul x12 x18))) (Add (Add (Mul x13 x16) (Mul x14
    x17)) (Mul x15 x18)))) (Num 1 (-1000)))) (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x1
    x19) (Mul x4 x20)) (Mul x7 x21)) (Add (Add (Mul x10 x19) (Mul x11 x20)) (Mul x12 x21))) (Add
    (Add (Mul x13 x19) (Mul x14 x20)) (Mul x15 x21)))) (Num 1 (-1000))))) (Var "left")) x22)
    (Num 1 (-1))) (Add (Var "reach") (Mul (Num 1 (-46)) (Add (Add (Abs (Div (Var "left") x22))
    (Var "width")) (Var "height")))))) (Num 1 0) in
  Where (Not (Same x23 x23)) (Var "region_x_end") (Min (Max x23 (Var "region_x"))
    (Var "region_x_end")).

(** candidates.pixel_bounds, orthographic: y0 *)
Definition pixel_bounds_parallel_y0 : expr :=
  let x1 := Abs (Var "right_x") in
  let x2 := Abs (Var "ox") in
  let x3 := Add (Abs (Var "ax")) x2 in
  let x4 := Abs (Var "right_y") in
  let x5 := Abs (Var "oy") in
  let x6 := Add (Abs (Var "ay")) x5 in
  let x7 := Abs (Var "right_z") in
  let x8 := Abs (Var "oz") in
  let x9 := Add (Abs (Var "az")) x8 in
  let x10 := Abs (Var "up_x") in
  let x11 := Abs (Var "up_y") in
  let x12 := Abs (Var "up_z") in
  let x13 := Abs (Var "depth_x") in
  let x14 := Abs (Var "depth_y") in
  let x15 := Abs (Var "depth_z") in
  let x16 := Add (Abs (Var "bx")) x2 in
  let x17 := Add (Abs (Var "by")) x5 in
  let x18 := Add (Abs (Var "bz")) x8 in
  let x19 := Add (Abs (Var "cx")) x2 in
  let x20 := Add (Abs (Var "cy")) x5 in
  let x21 := Add (Abs (Var "cz")) x8 in
  let x22 := Div (Sub (Var "top") (Var "bottom")) (Var "height") in
  let x23 := Ceil (Sub (Sub (Div (Sub (Sub (Min (Min (Add (Add (Mul (Var "up_x") (Sub (Var "ax")
    (Var "ox"))) (Mul (Var "up_y") (Sub (Var "ay") (Var "oy")))) (Mul (Var "up_z") (Sub (Var "az")
    (Var "oz")))) (Add (Add (Mul (Var "up_x") (Sub (Var "bx") (Var "ox"))) (Mul (Var "up_y") (Sub
    (Var "by") (Var "oy")))) (Mul (Var "up_z") (Sub (Var "bz") (Var "oz"))))) (Add (Add (Mul
    (Var "up_x") (Sub (Var "cx") (Var "ox"))) (Mul (Var "up_y") (Sub (Var "cy") (Var "oy")))) (Mul
    (Var "up_z") (Sub (Var "cz") (Var "oz"))))) (Max (Max (Add (Mul (Num 1 (-46)) (Add (Add (Add
    (Add (Mul x1 x3) (Mul x4 x6)) (Mul x7 x9)) (Add (Add (Mul x10 x3) (Mul x11 x6)) (Mul x12 x9)))
    (Add (Add (Mul x13 x3) (Mul x14 x6)) (Mul x15 x9)))) (Num 1 (-1000))) (Add (Mul (Num 1 (-46))
    (Add (Add (Add (Add (Mul x1 x16) (Mul x4 x17)) (Mul x7 x18)) (Add (Add (Mul x10 x16) (Mul x11
    x17)) (Mul x12 x18))) (Add (Add (Mul x13 x16) (Mul x14 x17)) (Mul x15 x18)))) (Num 1 (-1000))))
    (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x1 x19) (Mul x4 x20)) (Mul x7 x21)) (Add (Add
    (Mul x10 x19) (Mul x11 x20)) (Mul x12 x21))) (Add (Add (Mul x13 x19) (Mul x14 x20)) (Mul x15
    x21)))) (Num 1 (-1000))))) (Var "bottom")) x22) (Num 1 (-1))) (Add (Var "reach") (Mul
    (Num 1 (-46)) (Add (Add (Abs (Div (Var "bottom") x22)) (Var "width")) (Var "height"))))) in
  Where (Not (Same x23 x23)) (Var "region_y") (Min (Max x23 (Var "region_y")) (Var "region_y_end")).

(** candidates.pixel_bounds, orthographic: y1 *)
Definition pixel_bounds_parallel_y1 : expr :=
  let x1 := Abs (Var "right_x") in
  let x2 := Abs (Var "ox") in
  let x3 := Add (Abs (Var "ax")) x2 in
  let x4 := Abs (Var "right_y") in
  let x5 := Abs (Var "oy") in
  let x6 := Add (Abs (Var "ay")) x5 in
  let x7 := Abs (Var "right_z") in
  let x8 := Abs (Var "oz") in
  let x9 := Add (Abs (Var "az")) x8 in
  let x10 := Abs (Var "up_x") in
  let x11 := Abs (Var "up_y") in
  let x12 := Abs (Var "up_z") in
  let x13 := Abs (Var "depth_x") in
  let x14 := Abs (Var "depth_y") in
  let x15 := Abs (Var "depth_z") in
  let x16 := Add (Abs (Var "bx")) x2 in
  let x17 := Add (Abs (Var "by")) x5 in
  let x18 := Add (Abs (Var "bz")) x8 in
  let x19 := Add (Abs (Var "cx")) x2 in
  let x20 := Add (Abs (Var "cy")) x5 in
  let x21 := Add (Abs (Var "cz")) x8 in
  let x22 := Div (Sub (Var "top") (Var "bottom")) (Var "height") in
  let x23 := Add (Floor (Add (Sub (Div (Sub (Add (Max (Max (Add (Add (Mul (Var "up_x") (Sub
    (Var "ax") (Var "ox"))) (Mul (Var "up_y") (Sub (Var "ay") (Var "oy")))) (Mul (Var "up_z") (Sub
    (Var "az") (Var "oz")))) (Add (Add (Mul (Var "up_x") (Sub (Var "bx") (Var "ox"))) (Mul
    (Var "up_y") (Sub (Var "by") (Var "oy")))) (Mul (Var "up_z") (Sub (Var "bz") (Var "oz"))))) (Add
    (Add (Mul (Var "up_x") (Sub (Var "cx") (Var "ox"))) (Mul (Var "up_y") (Sub (Var "cy")
    (Var "oy")))) (Mul (Var "up_z") (Sub (Var "cz") (Var "oz"))))) (Max (Max (Add (Mul (Num 1 (-46))
    (Add (Add (Add (Add (Mul x1 x3) (Mul x4 x6)) (Mul x7 x9)) (Add (Add (Mul x10 x3) (Mul x11 x6))
    (Mul x12 x9))) (Add (Add (Mul x13 x3) (Mul x14 x6)) (Mul x15 x9)))) (Num 1 (-1000))) (Add (Mul
    (Num 1 (-46)) (Add (Add (Add (Add (Mul x1 x16) (Mul x4 x17)) (Mul x7 x18)) (Add (Add (Mul x10
    x16) (Mul x11 x17)) (Mul x12 x18))) (Add (Add (Mul x13 x16) (Mul x14 x17)) (Mul x15 x18))))
    (Num 1 (-1000)))) (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x1 x19) (Mul x4 x20)) (Mul x7
    x21)) (Add (Add (Mul x10 x19) (Mul x11 x20)) (Mul x12 x21))) (Add (Add (Mul x13 x19) (Mul x14
    x20)) (Mul x15 x21)))) (Num 1 (-1000))))) (Var "bottom")) x22) (Num 1 (-1))) (Add (Var "reach")
    (Mul (Num 1 (-46)) (Add (Add (Abs (Div (Var "bottom") x22)) (Var "width")) (Var "height"))))))
    (Num 1 0) in
  Where (Not (Same x23 x23)) (Var "region_y_end") (Min (Max x23 (Var "region_y"))
    (Var "region_y_end")).

(** candidates.pixel_bounds, orthographic: path *)
Definition pixel_bounds_parallel_path : test :=
  let x1 := Add (Add (Mul (Var "depth_x") (Sub (Var "ax") (Var "ox"))) (Mul (Var "depth_y") (Sub
    (Var "ay") (Var "oy")))) (Mul (Var "depth_z") (Sub (Var "az") (Var "oz"))) in
  let x2 := Add (Add (Mul (Var "depth_x") (Sub (Var "bx") (Var "ox"))) (Mul (Var "depth_y") (Sub
    (Var "by") (Var "oy")))) (Mul (Var "depth_z") (Sub (Var "bz") (Var "oz"))) in
  let x3 := Add (Add (Mul (Var "depth_x") (Sub (Var "cx") (Var "ox"))) (Mul (Var "depth_y") (Sub
    (Var "cy") (Var "oy")))) (Mul (Var "depth_z") (Sub (Var "cz") (Var "oz"))) in
  let x4 := Abs (Var "right_x") in
  let x5 := Abs (Var "ox") in
  let x6 := Add (Abs (Var "ax")) x5 in
  let x7 := Abs (Var "right_y") in
  let x8 := Abs (Var "oy") in
  let x9 := Add (Abs (Var "ay")) x8 in
  let x10 := Abs (Var "right_z") in
  let x11 := Abs (Var "oz") in
  let x12 := Add (Abs (Var "az")) x11 in
  let x13 := Abs (Var "up_x") in
  let x14 := Abs (Var "up_y") in
  let x15 := Abs (Var "up_z") in
  let x16 := Abs (Var "depth_x") in
  let x17 := Abs (Var "depth_y") in
  let x18 := Abs (Var "depth_z") in
  let x19 := Add (Abs (Var "bx")) x5 in
  let x20 := Add (Abs (Var "by")) x8 in
  let x21 := Add (Abs (Var "bz")) x11 in
  let x22 := Add (Abs (Var "cx")) x5 in
  let x23 := Add (Abs (Var "cy")) x8 in
  let x24 := Add (Abs (Var "cz")) x11 in
  let x25 := Max (Max (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x4 x6) (Mul x7 x9)) (Mul x10
    x12)) (Add (Add (Mul x13 x6) (Mul x14 x9)) (Mul x15 x12))) (Add (Add (Mul x16 x6) (Mul x17 x9))
    (Mul x18 x12)))) (Num 1 (-1000))) (Add (Mul (Num 1 (-46)) (Add (Add (Add (Add (Mul x4 x19) (Mul
    x7 x20)) (Mul x10 x21)) (Add (Add (Mul x13 x19) (Mul x14 x20)) (Mul x15 x21))) (Add (Add (Mul
    x16 x19) (Mul x17 x20)) (Mul x18 x21)))) (Num 1 (-1000)))) (Add (Mul (Num 1 (-46)) (Add (Add
    (Add (Add (Mul x4 x22) (Mul x7 x23)) (Mul x10 x24)) (Add (Add (Mul x13 x22) (Mul x14 x23)) (Mul
    x15 x24))) (Add (Add (Mul x16 x22) (Mul x17 x23)) (Mul x18 x24)))) (Num 1 (-1000))) in
  Not (Or (Less (Add (Max (Max x1 x2) x3) x25) (Var "clip_start")) (Less (Var "clip_end") (Sub (Min
    (Min x1 x2) x3) x25))).

(** vector.transform_points: x *)
Definition transform_x : expr :=
  Add (Add (Add (Mul (Var "m00") (Var "vx")) (Mul (Var "m01") (Var "vy"))) (Mul (Var "m02")
    (Var "vz"))) (Var "m03").

(** vector.transform_points: y *)
Definition transform_y : expr :=
  Add (Add (Add (Mul (Var "m10") (Var "vx")) (Mul (Var "m11") (Var "vy"))) (Mul (Var "m12")
    (Var "vz"))) (Var "m13").

(** vector.transform_points: z *)
Definition transform_z : expr :=
  Add (Add (Add (Mul (Var "m20") (Var "vx")) (Mul (Var "m21") (Var "vy"))) (Mul (Var "m22")
    (Var "vz"))) (Var "m23").

(** boxes.InstanceBoxes.of, perspective: in view *)
Definition instance_perspective_in_view : test :=
  let x1 := Mul (Num 1 2) (Add (Var "size") (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz")))) in
  let x2 := Add (Var "d0") (Mul (Var "d1") x1) in
  let x3 := Sub (Var "region_x") (Num 1 0) in
  let x4 := Add (Var "c0") (Mul (Var "c1") x1) in
  let x5 := Mul (Var "weight") x1 in
  let x6 := Neg (Add x4 (Mul (Abs x3) x5)) in
  let x7 := Add (Var "region_x_end") (Num 1 0) in
  let x8 := Neg (Add x4 (Mul (Abs x7) x5)) in
  let x9 := Sub (Var "region_y") (Num 1 0) in
  let x10 := Neg (Add x4 (Mul (Abs x9) x5)) in
  let x11 := Add (Var "region_y_end") (Num 1 0) in
  let x12 := Neg (Add x4 (Mul (Abs x11) x5)) in
  Not (Or (Or (Or (Or (Or (And (And (And (And (And (And (And (Less (Add (Var "depth0") x2)
    (Var "clip_start")) (Less (Add (Var "depth1") x2) (Var "clip_start"))) (Less (Add (Var "depth2")
    x2) (Var "clip_start"))) (Less (Add (Var "depth3") x2) (Var "clip_start"))) (Less (Add
    (Var "depth4") x2) (Var "clip_start"))) (Less (Add (Var "depth5") x2) (Var "clip_start"))) (Less
    (Add (Var "depth6") x2) (Var "clip_start"))) (Less (Add (Var "depth7") x2) (Var "clip_start")))
    (And (And (And (And (And (And (And (Less (Var "clip_end") (Sub (Var "depth0") x2)) (Less
    (Var "clip_end") (Sub (Var "depth1") x2))) (Less (Var "clip_end") (Sub (Var "depth2") x2)))
    (Less (Var "clip_end") (Sub (Var "depth3") x2))) (Less (Var "clip_end") (Sub (Var "depth4")
    x2))) (Less (Var "clip_end") (Sub (Var "depth5") x2))) (Less (Var "clip_end") (Sub
    (Var "depth6") x2))) (Less (Var "clip_end") (Sub (Var "depth7") x2)))) (And (And (And (And (And
    (And (And (Less (Mul (Num 1 0) (Sub (Var "p0") (Mul x3 (Var "w0")))) x6) (Less (Mul (Num 1 0)
    (Sub (Var "p1") (Mul x3 (Var "w1")))) x6)) (Less (Mul (Num 1 0) (Sub (Var "p2") (Mul x3
    (Var "w2")))) x6)) (Less (Mul (Num 1 0) (Sub (Var "p3") (Mul x3 (Var "w3")))) x6)) (Less (Mul
    (Num 1 0) (Sub (Var "p4") (Mul x3 (Var "w4")))) x6)) (Less (Mul (Num 1 0) (Sub (Var "p5") (Mul
    x3 (Var "w5")))) x6)) (Less (Mul (Num 1 0) (Sub (Var "p6") (Mul x3 (Var "w6")))) x6)) (Less (Mul
    (Num 1 0) (Sub (Var "p7") (Mul x3 (Var "w7")))) x6))) (And (And (And (And (And (And (And (Less
    (Mul (Num (-1) 0) (Sub (Var "p0") (Mul x7 (Var "w0")))) x8) (Less (Mul (Num (-1) 0) (Sub
    (Var "p1") (Mul x7 (Var "w1")))) x8)) (Less (Mul (Num (-1) 0) (Sub (Var "p2") (Mul x7
    (Var "w2")))) x8)) (Less (Mul (Num (-1) 0) (Sub (Var "p3") (Mul x7 (Var "w3")))) x8)) (Less (Mul
    (Num (-1) 0) (Sub (Var "p4") (Mul x7 (Var "w4")))) x8)) (Less (Mul (Num (-1) 0) (Sub (Var "p5")
    (Mul x7 (Var "w5")))) x8)) (Less (Mul (Num (-1) 0) (Sub (Var "p6") (Mul x7 (Var "w6")))) x8))
    (Less (Mul (Num (-1) 0) (Sub (Var "p7") (Mul x7 (Var "w7")))) x8))) (And (And (And (And (And
    (And (And (Less (Mul (Num 1 0) (Sub (Var "q0") (Mul x9 (Var "w0")))) x10) (Less (Mul (Num 1 0)
    (Sub (Var "q1") (Mul x9 (Var "w1")))) x10)) (Less (Mul (Num 1 0) (Sub (Var "q2") (Mul x9
    (Var "w2")))) x10)) (Less (Mul (Num 1 0) (Sub (Var "q3") (Mul x9 (Var "w3")))) x10)) (Less (Mul
    (Num 1 0) (Sub (Var "q4") (Mul x9 (Var "w4")))) x10)) (Less (Mul (Num 1 0) (Sub (Var "q5") (Mul
    x9 (Var "w5")))) x10)) (Less (Mul (Num 1 0) (Sub (Var "q6") (Mul x9 (Var "w6")))) x10)) (Less
    (Mul (Num 1 0) (Sub (Var "q7") (Mul x9 (Var "w7")))) x10))) (And (And (And (And (And (And (And
    (Less (Mul (Num (-1) 0) (Sub (Var "q0") (Mul x11 (Var "w0")))) x12) (Less (Mul (Num (-1) 0) (Sub
    (Var "q1") (Mul x11 (Var "w1")))) x12)) (Less (Mul (Num (-1) 0) (Sub (Var "q2") (Mul x11
    (Var "w2")))) x12)) (Less (Mul (Num (-1) 0) (Sub (Var "q3") (Mul x11 (Var "w3")))) x12)) (Less
    (Mul (Num (-1) 0) (Sub (Var "q4") (Mul x11 (Var "w4")))) x12)) (Less (Mul (Num (-1) 0) (Sub
    (Var "q5") (Mul x11 (Var "w5")))) x12)) (Less (Mul (Num (-1) 0) (Sub (Var "q6") (Mul x11
    (Var "w6")))) x12)) (Less (Mul (Num (-1) 0) (Sub (Var "q7") (Mul x11 (Var "w7")))) x12))).

(** boxes.InstanceBoxes.of, perspective: low x *)
Definition instance_perspective_low_x : expr :=
  let x1 := Mul (Num 1 2) (Add (Var "size") (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz")))) in
  let x2 := Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Max (Var "width") (Var "height")) (Mul
    (Var "weight") x1)) in
  Where (And (And (And (And (And (And (And (And (And (Given "ahead0") (Less x2 (Mul (Num 1 (-2))
    (Var "w0")))) (And (Given "ahead1") (Less x2 (Mul (Num 1 (-2)) (Var "w1"))))) (And
    (Given "ahead2") (Less x2 (Mul (Num 1 (-2)) (Var "w2"))))) (And (Given "ahead3") (Less x2 (Mul
    (Num 1 (-2)) (Var "w3"))))) (And (Given "ahead4") (Less x2 (Mul (Num 1 (-2)) (Var "w4"))))) (And
    (Given "ahead5") (Less x2 (Mul (Num 1 (-2)) (Var "w5"))))) (And (Given "ahead6") (Less x2 (Mul
    (Num 1 (-2)) (Var "w6"))))) (And (Given "ahead7") (Less x2 (Mul (Num 1 (-2)) (Var "w7")))))
    (Same (Num 0 0) (Num 0 0))) (Sub (Min (Min (Min (Min (Min (Min (Min (Var "low_x0")
    (Var "low_x1")) (Var "low_x2")) (Var "low_x3")) (Var "low_x4")) (Var "low_x5")) (Var "low_x6"))
    (Var "low_x7")) (Num 1 0)) (Num (-1) 31).

(** boxes.InstanceBoxes.of, perspective: low y *)
Definition instance_perspective_low_y : expr :=
  let x1 := Mul (Num 1 2) (Add (Var "size") (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz")))) in
  let x2 := Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Max (Var "width") (Var "height")) (Mul
    (Var "weight") x1)) in
  Where (And (And (And (And (And (And (And (And (And (Given "ahead0") (Less x2 (Mul (Num 1 (-2))
    (Var "w0")))) (And (Given "ahead1") (Less x2 (Mul (Num 1 (-2)) (Var "w1"))))) (And
    (Given "ahead2") (Less x2 (Mul (Num 1 (-2)) (Var "w2"))))) (And (Given "ahead3") (Less x2 (Mul
    (Num 1 (-2)) (Var "w3"))))) (And (Given "ahead4") (Less x2 (Mul (Num 1 (-2)) (Var "w4"))))) (And
    (Given "ahead5") (Less x2 (Mul (Num 1 (-2)) (Var "w5"))))) (And (Given "ahead6") (Less x2 (Mul
    (Num 1 (-2)) (Var "w6"))))) (And (Given "ahead7") (Less x2 (Mul (Num 1 (-2)) (Var "w7")))))
    (Same (Num 0 0) (Num 0 0))) (Sub (Min (Min (Min (Min (Min (Min (Min (Var "low_y0")
    (Var "low_y1")) (Var "low_y2")) (Var "low_y3")) (Var "low_y4")) (Var "low_y5")) (Var "low_y6"))
    (Var "low_y7")) (Num 1 0)) (Num (-1) 31).

(** boxes.InstanceBoxes.of, perspective: high x *)
Definition instance_perspective_high_x : expr :=
  let x1 := Mul (Num 1 2) (Add (Var "size") (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz")))) in
  let x2 := Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Max (Var "width") (Var "height")) (Mul
    (Var "weight") x1)) in
  Where (And (And (And (And (And (And (And (And (And (Given "ahead0") (Less x2 (Mul (Num 1 (-2))
    (Var "w0")))) (And (Given "ahead1") (Less x2 (Mul (Num 1 (-2)) (Var "w1"))))) (And
    (Given "ahead2") (Less x2 (Mul (Num 1 (-2)) (Var "w2"))))) (And (Given "ahead3") (Less x2 (Mul
    (Num 1 (-2)) (Var "w3"))))) (And (Given "ahead4") (Less x2 (Mul (Num 1 (-2)) (Var "w4"))))) (And
    (Given "ahead5") (Less x2 (Mul (Num 1 (-2)) (Var "w5"))))) (And (Given "ahead6") (Less x2 (Mul
    (Num 1 (-2)) (Var "w6"))))) (And (Given "ahead7") (Less x2 (Mul (Num 1 (-2)) (Var "w7")))))
    (Same (Num 0 0) (Num 0 0))) (Add (Neg (Min (Min (Min (Min (Min (Min (Min (Var "minus_high_x0")
    (Var "minus_high_x1")) (Var "minus_high_x2")) (Var "minus_high_x3")) (Var "minus_high_x4"))
    (Var "minus_high_x5")) (Var "minus_high_x6")) (Var "minus_high_x7"))) (Num 1 0))
    (Num 2147483647 0).

(** boxes.InstanceBoxes.of, perspective: high y *)
Definition instance_perspective_high_y : expr :=
  let x1 := Mul (Num 1 2) (Add (Var "size") (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz")))) in
  let x2 := Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Max (Var "width") (Var "height")) (Mul
    (Var "weight") x1)) in
  Where (And (And (And (And (And (And (And (And (And (Given "ahead0") (Less x2 (Mul (Num 1 (-2))
    (Var "w0")))) (And (Given "ahead1") (Less x2 (Mul (Num 1 (-2)) (Var "w1"))))) (And
    (Given "ahead2") (Less x2 (Mul (Num 1 (-2)) (Var "w2"))))) (And (Given "ahead3") (Less x2 (Mul
    (Num 1 (-2)) (Var "w3"))))) (And (Given "ahead4") (Less x2 (Mul (Num 1 (-2)) (Var "w4"))))) (And
    (Given "ahead5") (Less x2 (Mul (Num 1 (-2)) (Var "w5"))))) (And (Given "ahead6") (Less x2 (Mul
    (Num 1 (-2)) (Var "w6"))))) (And (Given "ahead7") (Less x2 (Mul (Num 1 (-2)) (Var "w7")))))
    (Same (Num 0 0) (Num 0 0))) (Add (Neg (Min (Min (Min (Min (Min (Min (Min (Var "minus_high_y0")
    (Var "minus_high_y1")) (Var "minus_high_y2")) (Var "minus_high_y3")) (Var "minus_high_y4"))
    (Var "minus_high_y5")) (Var "minus_high_y6")) (Var "minus_high_y7"))) (Num 1 0))
    (Num 2147483647 0).

(** boxes.InstanceBoxes.of, perspective: nearest *)
Definition instance_perspective_nearest : expr :=
  let x1 := Mul (Num 1 2) (Add (Var "size") (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz")))) in
  let x2 := Mul (Var "weight") x1 in
  let x3 := Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Max (Var "width") (Var "height")) x2) in
  Where (And (And (And (And (And (And (And (And (And (Given "ahead0") (Less x3 (Mul (Num 1 (-2))
    (Var "w0")))) (And (Given "ahead1") (Less x3 (Mul (Num 1 (-2)) (Var "w1"))))) (And
    (Given "ahead2") (Less x3 (Mul (Num 1 (-2)) (Var "w2"))))) (And (Given "ahead3") (Less x3 (Mul
    (Num 1 (-2)) (Var "w3"))))) (And (Given "ahead4") (Less x3 (Mul (Num 1 (-2)) (Var "w4"))))) (And
    (Given "ahead5") (Less x3 (Mul (Num 1 (-2)) (Var "w5"))))) (And (Given "ahead6") (Less x3 (Mul
    (Num 1 (-2)) (Var "w6"))))) (And (Given "ahead7") (Less x3 (Mul (Num 1 (-2)) (Var "w7")))))
    (Same (Num 0 0) (Num 0 0))) (Div (Add (Num 281474976710657 (-48)) (Mul (Num 1 1)
    (Var "ray_error"))) (Max (Sub (Min (Min (Min (Min (Min (Min (Min (Var "depth0") (Var "depth1"))
    (Var "depth2")) (Var "depth3")) (Var "depth4")) (Var "depth5")) (Var "depth6")) (Var "depth7"))
    x2) (Var "clip_start"))) Inf.

(** boxes.InstanceBoxes.of, orthographic: in view *)
Definition instance_parallel_in_view : test :=
  let x1 := Mul (Num 1 2) (Add (Var "size") (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz")))) in
  let x2 := Add (Var "d0") (Mul (Var "d1") x1) in
  let x3 := Sub (Var "region_x") (Num 1 0) in
  let x4 := Add (Var "c0") (Mul (Var "c1") x1) in
  let x5 := Mul (Num 0 0) x1 in
  let x6 := Neg (Add x4 (Mul (Abs x3) x5)) in
  let x7 := Add (Var "region_x_end") (Num 1 0) in
  let x8 := Neg (Add x4 (Mul (Abs x7) x5)) in
  let x9 := Sub (Var "region_y") (Num 1 0) in
  let x10 := Neg (Add x4 (Mul (Abs x9) x5)) in
  let x11 := Add (Var "region_y_end") (Num 1 0) in
  let x12 := Neg (Add x4 (Mul (Abs x11) x5)) in
  Not (Or (Or (Or (Or (Or (And (And (And (And (And (And (And (Less (Add (Var "depth0") x2)
    (Var "clip_start")) (Less (Add (Var "depth1") x2) (Var "clip_start"))) (Less (Add (Var "depth2")
    x2) (Var "clip_start"))) (Less (Add (Var "depth3") x2) (Var "clip_start"))) (Less (Add
    (Var "depth4") x2) (Var "clip_start"))) (Less (Add (Var "depth5") x2) (Var "clip_start"))) (Less
    (Add (Var "depth6") x2) (Var "clip_start"))) (Less (Add (Var "depth7") x2) (Var "clip_start")))
    (And (And (And (And (And (And (And (Less (Var "clip_end") (Sub (Var "depth0") x2)) (Less
    (Var "clip_end") (Sub (Var "depth1") x2))) (Less (Var "clip_end") (Sub (Var "depth2") x2)))
    (Less (Var "clip_end") (Sub (Var "depth3") x2))) (Less (Var "clip_end") (Sub (Var "depth4")
    x2))) (Less (Var "clip_end") (Sub (Var "depth5") x2))) (Less (Var "clip_end") (Sub
    (Var "depth6") x2))) (Less (Var "clip_end") (Sub (Var "depth7") x2)))) (And (And (And (And (And
    (And (And (Less (Mul (Num 1 0) (Sub (Var "p0") (Mul x3 (Var "w0")))) x6) (Less (Mul (Num 1 0)
    (Sub (Var "p1") (Mul x3 (Var "w1")))) x6)) (Less (Mul (Num 1 0) (Sub (Var "p2") (Mul x3
    (Var "w2")))) x6)) (Less (Mul (Num 1 0) (Sub (Var "p3") (Mul x3 (Var "w3")))) x6)) (Less (Mul
    (Num 1 0) (Sub (Var "p4") (Mul x3 (Var "w4")))) x6)) (Less (Mul (Num 1 0) (Sub (Var "p5") (Mul
    x3 (Var "w5")))) x6)) (Less (Mul (Num 1 0) (Sub (Var "p6") (Mul x3 (Var "w6")))) x6)) (Less (Mul
    (Num 1 0) (Sub (Var "p7") (Mul x3 (Var "w7")))) x6))) (And (And (And (And (And (And (And (Less
    (Mul (Num (-1) 0) (Sub (Var "p0") (Mul x7 (Var "w0")))) x8) (Less (Mul (Num (-1) 0) (Sub
    (Var "p1") (Mul x7 (Var "w1")))) x8)) (Less (Mul (Num (-1) 0) (Sub (Var "p2") (Mul x7
    (Var "w2")))) x8)) (Less (Mul (Num (-1) 0) (Sub (Var "p3") (Mul x7 (Var "w3")))) x8)) (Less (Mul
    (Num (-1) 0) (Sub (Var "p4") (Mul x7 (Var "w4")))) x8)) (Less (Mul (Num (-1) 0) (Sub (Var "p5")
    (Mul x7 (Var "w5")))) x8)) (Less (Mul (Num (-1) 0) (Sub (Var "p6") (Mul x7 (Var "w6")))) x8))
    (Less (Mul (Num (-1) 0) (Sub (Var "p7") (Mul x7 (Var "w7")))) x8))) (And (And (And (And (And
    (And (And (Less (Mul (Num 1 0) (Sub (Var "q0") (Mul x9 (Var "w0")))) x10) (Less (Mul (Num 1 0)
    (Sub (Var "q1") (Mul x9 (Var "w1")))) x10)) (Less (Mul (Num 1 0) (Sub (Var "q2") (Mul x9
    (Var "w2")))) x10)) (Less (Mul (Num 1 0) (Sub (Var "q3") (Mul x9 (Var "w3")))) x10)) (Less (Mul
    (Num 1 0) (Sub (Var "q4") (Mul x9 (Var "w4")))) x10)) (Less (Mul (Num 1 0) (Sub (Var "q5") (Mul
    x9 (Var "w5")))) x10)) (Less (Mul (Num 1 0) (Sub (Var "q6") (Mul x9 (Var "w6")))) x10)) (Less
    (Mul (Num 1 0) (Sub (Var "q7") (Mul x9 (Var "w7")))) x10))) (And (And (And (And (And (And (And
    (Less (Mul (Num (-1) 0) (Sub (Var "q0") (Mul x11 (Var "w0")))) x12) (Less (Mul (Num (-1) 0) (Sub
    (Var "q1") (Mul x11 (Var "w1")))) x12)) (Less (Mul (Num (-1) 0) (Sub (Var "q2") (Mul x11
    (Var "w2")))) x12)) (Less (Mul (Num (-1) 0) (Sub (Var "q3") (Mul x11 (Var "w3")))) x12)) (Less
    (Mul (Num (-1) 0) (Sub (Var "q4") (Mul x11 (Var "w4")))) x12)) (Less (Mul (Num (-1) 0) (Sub
    (Var "q5") (Mul x11 (Var "w5")))) x12)) (Less (Mul (Num (-1) 0) (Sub (Var "q6") (Mul x11
    (Var "w6")))) x12)) (Less (Mul (Num (-1) 0) (Sub (Var "q7") (Mul x11 (Var "w7")))) x12))).

(** boxes.InstanceBoxes.of, orthographic: low x *)
Definition instance_parallel_low_x : expr :=
  let x1 := Mul (Num 1 2) (Add (Var "size") (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz")))) in
  let x2 := Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Max (Var "width") (Var "height")) (Mul
    (Num 0 0) x1)) in
  Where (And (And (And (And (And (And (And (And (And (Given "ahead0") (Less x2 (Mul (Num 1 (-2))
    (Var "w0")))) (And (Given "ahead1") (Less x2 (Mul (Num 1 (-2)) (Var "w1"))))) (And
    (Given "ahead2") (Less x2 (Mul (Num 1 (-2)) (Var "w2"))))) (And (Given "ahead3") (Less x2 (Mul
    (Num 1 (-2)) (Var "w3"))))) (And (Given "ahead4") (Less x2 (Mul (Num 1 (-2)) (Var "w4"))))) (And
    (Given "ahead5") (Less x2 (Mul (Num 1 (-2)) (Var "w5"))))) (And (Given "ahead6") (Less x2 (Mul
    (Num 1 (-2)) (Var "w6"))))) (And (Given "ahead7") (Less x2 (Mul (Num 1 (-2)) (Var "w7")))))
    (Same (Num 0 0) (Num 0 0))) (Sub (Min (Min (Min (Min (Min (Min (Min (Var "low_x0")
    (Var "low_x1")) (Var "low_x2")) (Var "low_x3")) (Var "low_x4")) (Var "low_x5")) (Var "low_x6"))
    (Var "low_x7")) (Num 1 0)) (Num (-1) 31).

(** boxes.InstanceBoxes.of, orthographic: low y *)
Definition instance_parallel_low_y : expr :=
  let x1 := Mul (Num 1 2) (Add (Var "size") (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz")))) in
  let x2 := Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Max (Var "width") (Var "height")) (Mul
    (Num 0 0) x1)) in
  Where (And (And (And (And (And (And (And (And (And (Given "ahead0") (Less x2 (Mul (Num 1 (-2))
    (Var "w0")))) (And (Given "ahead1") (Less x2 (Mul (Num 1 (-2)) (Var "w1"))))) (And
    (Given "ahead2") (Less x2 (Mul (Num 1 (-2)) (Var "w2"))))) (And (Given "ahead3") (Less x2 (Mul
    (Num 1 (-2)) (Var "w3"))))) (And (Given "ahead4") (Less x2 (Mul (Num 1 (-2)) (Var "w4"))))) (And
    (Given "ahead5") (Less x2 (Mul (Num 1 (-2)) (Var "w5"))))) (And (Given "ahead6") (Less x2 (Mul
    (Num 1 (-2)) (Var "w6"))))) (And (Given "ahead7") (Less x2 (Mul (Num 1 (-2)) (Var "w7")))))
    (Same (Num 0 0) (Num 0 0))) (Sub (Min (Min (Min (Min (Min (Min (Min (Var "low_y0")
    (Var "low_y1")) (Var "low_y2")) (Var "low_y3")) (Var "low_y4")) (Var "low_y5")) (Var "low_y6"))
    (Var "low_y7")) (Num 1 0)) (Num (-1) 31).

(** boxes.InstanceBoxes.of, orthographic: high x *)
Definition instance_parallel_high_x : expr :=
  let x1 := Mul (Num 1 2) (Add (Var "size") (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz")))) in
  let x2 := Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Max (Var "width") (Var "height")) (Mul
    (Num 0 0) x1)) in
  Where (And (And (And (And (And (And (And (And (And (Given "ahead0") (Less x2 (Mul (Num 1 (-2))
    (Var "w0")))) (And (Given "ahead1") (Less x2 (Mul (Num 1 (-2)) (Var "w1"))))) (And
    (Given "ahead2") (Less x2 (Mul (Num 1 (-2)) (Var "w2"))))) (And (Given "ahead3") (Less x2 (Mul
    (Num 1 (-2)) (Var "w3"))))) (And (Given "ahead4") (Less x2 (Mul (Num 1 (-2)) (Var "w4"))))) (And
    (Given "ahead5") (Less x2 (Mul (Num 1 (-2)) (Var "w5"))))) (And (Given "ahead6") (Less x2 (Mul
    (Num 1 (-2)) (Var "w6"))))) (And (Given "ahead7") (Less x2 (Mul (Num 1 (-2)) (Var "w7")))))
    (Same (Num 0 0) (Num 0 0))) (Add (Neg (Min (Min (Min (Min (Min (Min (Min (Var "minus_high_x0")
    (Var "minus_high_x1")) (Var "minus_high_x2")) (Var "minus_high_x3")) (Var "minus_high_x4"))
    (Var "minus_high_x5")) (Var "minus_high_x6")) (Var "minus_high_x7"))) (Num 1 0))
    (Num 2147483647 0).

(** boxes.InstanceBoxes.of, orthographic: high y *)
Definition instance_parallel_high_y : expr :=
  let x1 := Mul (Num 1 2) (Add (Var "size") (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz")))) in
  let x2 := Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Max (Var "width") (Var "height")) (Mul
    (Num 0 0) x1)) in
  Where (And (And (And (And (And (And (And (And (And (Given "ahead0") (Less x2 (Mul (Num 1 (-2))
    (Var "w0")))) (And (Given "ahead1") (Less x2 (Mul (Num 1 (-2)) (Var "w1"))))) (And
    (Given "ahead2") (Less x2 (Mul (Num 1 (-2)) (Var "w2"))))) (And (Given "ahead3") (Less x2 (Mul
    (Num 1 (-2)) (Var "w3"))))) (And (Given "ahead4") (Less x2 (Mul (Num 1 (-2)) (Var "w4"))))) (And
    (Given "ahead5") (Less x2 (Mul (Num 1 (-2)) (Var "w5"))))) (And (Given "ahead6") (Less x2 (Mul
    (Num 1 (-2)) (Var "w6"))))) (And (Given "ahead7") (Less x2 (Mul (Num 1 (-2)) (Var "w7")))))
    (Same (Num 0 0) (Num 0 0))) (Add (Neg (Min (Min (Min (Min (Min (Min (Min (Var "minus_high_y0")
    (Var "minus_high_y1")) (Var "minus_high_y2")) (Var "minus_high_y3")) (Var "minus_high_y4"))
    (Var "minus_high_y5")) (Var "minus_high_y6")) (Var "minus_high_y7"))) (Num 1 0))
    (Num 2147483647 0).

(** boxes.InstanceBoxes.of, orthographic: nearest *)
Definition instance_parallel_nearest : expr :=
  let x1 := Mul (Num 1 2) (Add (Var "size") (Max (Max (Abs (Var "ox")) (Abs (Var "oy"))) (Abs
    (Var "oz")))) in
  let x2 := Add (Add (Var "c0") (Mul (Var "c1") x1)) (Mul (Max (Var "width") (Var "height")) (Mul
    (Num 0 0) x1)) in
  Where (And (And (And (And (And (And (And (And (And (Given "ahead0") (Less x2 (Mul (Num 1 (-2))
    (Var "w0")))) (And (Given "ahead1") (Less x2 (Mul (Num 1 (-2)) (Var "w1"))))) (And
    (Given "ahead2") (Less x2 (Mul (Num 1 (-2)) (Var "w2"))))) (And (Given "ahead3") (Less x2 (Mul
    (Num 1 (-2)) (Var "w3"))))) (And (Given "ahead4") (Less x2 (Mul (Num 1 (-2)) (Var "w4"))))) (And
    (Given "ahead5") (Less x2 (Mul (Num 1 (-2)) (Var "w5"))))) (And (Given "ahead6") (Less x2 (Mul
    (Num 1 (-2)) (Var "w6"))))) (And (Given "ahead7") (Less x2 (Mul (Num 1 (-2)) (Var "w7")))))
    (Same (Num 0 0) (Num 0 0))) (Sub (Add (Var "d0") (Mul (Var "d1") x1)) (Min (Min (Min (Min (Min
    (Min (Min (Var "depth0") (Var "depth1")) (Var "depth2")) (Var "depth3")) (Var "depth4"))
    (Var "depth5")) (Var "depth6")) (Var "depth7"))) Inf.

(** boxes._corners, the box of a mesh: corner 0 x *)
Definition box_corner_0_x : expr :=
  Add (Add (Add (Mul (Var "m00") (Var "lx")) (Mul (Var "m01") (Var "ly"))) (Mul (Var "m02")
    (Var "lz"))) (Var "m03").

(** boxes._corners, the box of a mesh: corner 1 x *)
Definition box_corner_1_x : expr :=
  Add (Add (Add (Mul (Var "m00") (Var "hx")) (Mul (Var "m01") (Var "ly"))) (Mul (Var "m02")
    (Var "lz"))) (Var "m03").

(** boxes._corners, the box of a mesh: corner 2 x *)
Definition box_corner_2_x : expr :=
  Add (Add (Add (Mul (Var "m00") (Var "lx")) (Mul (Var "m01") (Var "hy"))) (Mul (Var "m02")
    (Var "lz"))) (Var "m03").

(** boxes._corners, the box of a mesh: corner 3 x *)
Definition box_corner_3_x : expr :=
  Add (Add (Add (Mul (Var "m00") (Var "hx")) (Mul (Var "m01") (Var "hy"))) (Mul (Var "m02")
    (Var "lz"))) (Var "m03").

(** boxes._corners, the box of a mesh: corner 4 x *)
Definition box_corner_4_x : expr :=
  Add (Add (Add (Mul (Var "m00") (Var "lx")) (Mul (Var "m01") (Var "ly"))) (Mul (Var "m02")
    (Var "hz"))) (Var "m03").

(** boxes._corners, the box of a mesh: corner 5 x *)
Definition box_corner_5_x : expr :=
  Add (Add (Add (Mul (Var "m00") (Var "hx")) (Mul (Var "m01") (Var "ly"))) (Mul (Var "m02")
    (Var "hz"))) (Var "m03").

(** boxes._corners, the box of a mesh: corner 6 x *)
Definition box_corner_6_x : expr :=
  Add (Add (Add (Mul (Var "m00") (Var "lx")) (Mul (Var "m01") (Var "hy"))) (Mul (Var "m02")
    (Var "hz"))) (Var "m03").

(** boxes._corners, the box of a mesh: corner 7 x *)
Definition box_corner_7_x : expr :=
  Add (Add (Add (Mul (Var "m00") (Var "hx")) (Mul (Var "m01") (Var "hy"))) (Mul (Var "m02")
    (Var "hz"))) (Var "m03").

(** boxes._corners, the box of a mesh: corner 0 y *)
Definition box_corner_0_y : expr :=
  Add (Add (Add (Mul (Var "m10") (Var "lx")) (Mul (Var "m11") (Var "ly"))) (Mul (Var "m12")
    (Var "lz"))) (Var "m13").

(** boxes._corners, the box of a mesh: corner 1 y *)
Definition box_corner_1_y : expr :=
  Add (Add (Add (Mul (Var "m10") (Var "hx")) (Mul (Var "m11") (Var "ly"))) (Mul (Var "m12")
    (Var "lz"))) (Var "m13").

(** boxes._corners, the box of a mesh: corner 2 y *)
Definition box_corner_2_y : expr :=
  Add (Add (Add (Mul (Var "m10") (Var "lx")) (Mul (Var "m11") (Var "hy"))) (Mul (Var "m12")
    (Var "lz"))) (Var "m13").

(** boxes._corners, the box of a mesh: corner 3 y *)
Definition box_corner_3_y : expr :=
  Add (Add (Add (Mul (Var "m10") (Var "hx")) (Mul (Var "m11") (Var "hy"))) (Mul (Var "m12")
    (Var "lz"))) (Var "m13").

(** boxes._corners, the box of a mesh: corner 4 y *)
Definition box_corner_4_y : expr :=
  Add (Add (Add (Mul (Var "m10") (Var "lx")) (Mul (Var "m11") (Var "ly"))) (Mul (Var "m12")
    (Var "hz"))) (Var "m13").

(** boxes._corners, the box of a mesh: corner 5 y *)
Definition box_corner_5_y : expr :=
  Add (Add (Add (Mul (Var "m10") (Var "hx")) (Mul (Var "m11") (Var "ly"))) (Mul (Var "m12")
    (Var "hz"))) (Var "m13").

(** boxes._corners, the box of a mesh: corner 6 y *)
Definition box_corner_6_y : expr :=
  Add (Add (Add (Mul (Var "m10") (Var "lx")) (Mul (Var "m11") (Var "hy"))) (Mul (Var "m12")
    (Var "hz"))) (Var "m13").

(** boxes._corners, the box of a mesh: corner 7 y *)
Definition box_corner_7_y : expr :=
  Add (Add (Add (Mul (Var "m10") (Var "hx")) (Mul (Var "m11") (Var "hy"))) (Mul (Var "m12")
    (Var "hz"))) (Var "m13").

(** boxes._corners, the box of a mesh: corner 0 z *)
Definition box_corner_0_z : expr :=
  Add (Add (Add (Mul (Var "m20") (Var "lx")) (Mul (Var "m21") (Var "ly"))) (Mul (Var "m22")
    (Var "lz"))) (Var "m23").

(** boxes._corners, the box of a mesh: corner 1 z *)
Definition box_corner_1_z : expr :=
  Add (Add (Add (Mul (Var "m20") (Var "hx")) (Mul (Var "m21") (Var "ly"))) (Mul (Var "m22")
    (Var "lz"))) (Var "m23").

(** boxes._corners, the box of a mesh: corner 2 z *)
Definition box_corner_2_z : expr :=
  Add (Add (Add (Mul (Var "m20") (Var "lx")) (Mul (Var "m21") (Var "hy"))) (Mul (Var "m22")
    (Var "lz"))) (Var "m23").

(** boxes._corners, the box of a mesh: corner 3 z *)
Definition box_corner_3_z : expr :=
  Add (Add (Add (Mul (Var "m20") (Var "hx")) (Mul (Var "m21") (Var "hy"))) (Mul (Var "m22")
    (Var "lz"))) (Var "m23").

(** boxes._corners, the box of a mesh: corner 4 z *)
Definition box_corner_4_z : expr :=
  Add (Add (Add (Mul (Var "m20") (Var "lx")) (Mul (Var "m21") (Var "ly"))) (Mul (Var "m22")
    (Var "hz"))) (Var "m23").

(** boxes._corners, the box of a mesh: corner 5 z *)
Definition box_corner_5_z : expr :=
  Add (Add (Add (Mul (Var "m20") (Var "hx")) (Mul (Var "m21") (Var "ly"))) (Mul (Var "m22")
    (Var "hz"))) (Var "m23").

(** boxes._corners, the box of a mesh: corner 6 z *)
Definition box_corner_6_z : expr :=
  Add (Add (Add (Mul (Var "m20") (Var "lx")) (Mul (Var "m21") (Var "hy"))) (Mul (Var "m22")
    (Var "hz"))) (Var "m23").

(** boxes._corners, the box of a mesh: corner 7 z *)
Definition box_corner_7_z : expr :=
  Add (Add (Add (Mul (Var "m20") (Var "hx")) (Mul (Var "m21") (Var "hy"))) (Mul (Var "m22")
    (Var "hz"))) (Var "m23").

(** boxes._corners, the box of a mesh: size *)
Definition box_size : expr :=
  let x1 := Max (Abs (Var "lx")) (Abs (Var "hx")) in
  let x2 := Max (Abs (Var "ly")) (Abs (Var "hy")) in
  let x3 := Max (Abs (Var "lz")) (Abs (Var "hz")) in
  Max (Max (Add (Add (Add (Mul (Abs (Var "m00")) x1) (Mul (Abs (Var "m01")) x2)) (Mul (Abs
    (Var "m02")) x3)) (Abs (Var "m03"))) (Add (Add (Add (Mul (Abs (Var "m10")) x1) (Mul (Abs
    (Var "m11")) x2)) (Mul (Abs (Var "m12")) x3)) (Abs (Var "m13")))) (Add (Add (Add (Mul (Abs
    (Var "m20")) x1) (Mul (Abs (Var "m21")) x2)) (Mul (Abs (Var "m22")) x3)) (Abs (Var "m23"))).

(** small_boxes.are_small, where all vertices are certain *)
Definition are_small : test :=
  And (And (And (Less (Num 0 0) (Var "low_x")) (Less (Var "high_x") (Sub (Var "width") (Num 1 0))))
    (Less (Sub (Var "high_x") (Var "low_x")) (Num 1 4))) (And (And (Less (Num 0 0) (Var "low_y"))
    (Less (Var "high_y") (Sub (Var "height") (Num 1 0)))) (Less (Sub (Var "high_y") (Var "low_y"))
    (Num 1 4))).

(** small_boxes.are_small, where all vertices are certain: path *)
Definition are_small_path : test :=
  And (And (Given "certain_a") (Given "certain_b")) (Given "certain_c").

(** small_boxes.are_small, where some vertex is not certain *)
Definition are_small_some : test :=
  And (And (And (And (And (And (Less (Num 0 0) (Var "low_x")) (Less (Var "high_x") (Sub
    (Var "width") (Num 1 0)))) (Less (Sub (Var "high_x") (Var "low_x")) (Num 1 4))) (And (And (Less
    (Num 0 0) (Var "low_y")) (Less (Var "high_y") (Sub (Var "height") (Num 1 0)))) (Less (Sub
    (Var "high_y") (Var "low_y")) (Num 1 4)))) (Given "certain_a")) (Given "certain_b"))
    (Given "certain_c").

(** small_boxes.are_small, where some vertex is not certain: path *)
Definition are_small_some_path : test :=
  Not (And (And (Given "certain_a") (Given "certain_b")) (Given "certain_c")).

(** contest.Contest._candidates, what is sure: certain *)
Definition candidate_sure_certain : test :=
  Same (Where (And (Given "sure") (Finite (Var "high"))) (Where (And (Less (Var "start")
    (Var "low")) (Less (Var "high") (Var "end"))) (Num 0 0) (Num 1 1)) (Num 1 0)) (Num 0 0).

(** contest.Contest._candidates, what is sure: kept *)
Definition candidate_sure_kept : test :=
  And (Not (Or (Less (Var "high") (Var "start")) (Less (Var "end") (Var "low")))) (LessEq
    (Var "low") (Min (Var "farthest") (Var "high"))).

(** contest.Contest._candidates, what is sure: farthest *)
Definition candidate_sure_farthest : expr :=
  Min (Var "farthest") (Var "high").

(** contest.Contest._candidates, what is sure: path *)
Definition candidate_sure_path : test :=
  And (Not (Less (Var "start") (Num 0 0))) (Same (Where (And (Given "sure") (Finite (Var "high")))
    (Where (And (Less (Var "start") (Var "low")) (Less (Var "high") (Var "end"))) (Num 0 0)
    (Num 1 1)) (Num 1 0)) (Num 0 0)).

(** contest.Contest._candidates, what is in doubt: certain *)
Definition candidate_open_certain : test :=
  Same (Where (And (Given "sure") (Finite (Var "high"))) (Where (And (Less (Var "start")
    (Var "low")) (Less (Var "high") (Var "end"))) (Num 0 0) (Num 1 1)) (Num 1 0)) (Num 0 0).

(** contest.Contest._candidates, what is in doubt: kept *)
Definition candidate_open_kept : test :=
  And (Not (Or (Less (Var "high") (Var "start")) (Less (Var "end") (Var "low")))) (LessEq
    (Var "low") (Var "farthest")).

(** contest.Contest._candidates, what is in doubt: farthest *)
Definition candidate_open_farthest : expr :=
  Var "farthest".

(** contest.Contest._candidates, what is in doubt: path *)
Definition candidate_open_path : test :=
  And (Not (Less (Var "start") (Num 0 0))) (Not (Same (Where (And (Given "sure") (Finite
    (Var "high"))) (Where (And (Less (Var "start") (Var "low")) (Less (Var "high") (Var "end")))
    (Num 0 0) (Num 1 1)) (Num 1 0)) (Num 0 0))).

(** contest.Contest._prepare, rays from one point, two of them: around reach x *)
Definition around_reach_x : expr :=
  Max (Abs (Var "x1")) (Abs (Var "x2")).

(** contest.Contest._prepare, rays from one point, two of them: around reach y *)
Definition around_reach_y : expr :=
  Max (Abs (Var "y1")) (Abs (Var "y2")).

(** contest.Contest._prepare, rays from one point, two of them: around reach z *)
Definition around_reach_z : expr :=
  Max (Abs (Var "z1")) (Abs (Var "z2")).

(** contest.Contest._prepare, parallel rays, two of them: around low x *)
Definition around_low_x : expr :=
  Min (Var "x1") (Var "x2").

(** contest.Contest._prepare, parallel rays, two of them: around low y *)
Definition around_low_y : expr :=
  Min (Var "y1") (Var "y2").

(** contest.Contest._prepare, parallel rays, two of them: around low z *)
Definition around_low_z : expr :=
  Min (Var "z1") (Var "z2").

(** contest.Contest._prepare, parallel rays, two of them: around high x *)
Definition around_high_x : expr :=
  Max (Var "x1") (Var "x2").

(** contest.Contest._prepare, parallel rays, two of them: around high y *)
Definition around_high_y : expr :=
  Max (Var "y1") (Var "y2").

(** contest.Contest._prepare, parallel rays, two of them: around high z *)
Definition around_high_z : expr :=
  Max (Var "z1") (Var "z2").

(** camera.corner_rays, film positions: px0 *)
Definition corner_ray_px0 : expr :=
  Add (Num 1 (-1)) (Var "dx").

(** camera.corner_rays, film positions: px1 *)
Definition corner_ray_px1 : expr :=
  Add (Num 1 (-1)) (Var "dx").

(** camera.corner_rays, film positions: px2 *)
Definition corner_ray_px2 : expr :=
  Add (Sub (Var "width") (Num 1 (-1))) (Var "dx").

(** camera.corner_rays, film positions: px3 *)
Definition corner_ray_px3 : expr :=
  Add (Sub (Var "width") (Num 1 (-1))) (Var "dx").

(** camera.corner_rays, film positions: py0 *)
Definition corner_ray_py0 : expr :=
  Add (Num 1 (-1)) (Var "dy").

(** camera.corner_rays, film positions: py1 *)
Definition corner_ray_py1 : expr :=
  Add (Sub (Var "height") (Num 1 (-1))) (Var "dy").

(** camera.corner_rays, film positions: py2 *)
Definition corner_ray_py2 : expr :=
  Add (Num 1 (-1)) (Var "dy").

(** camera.corner_rays, film positions: py3 *)
Definition corner_ray_py3 : expr :=
  Add (Sub (Var "height") (Num 1 (-1))) (Var "dy").

(** sweep.Sweep.of_pairs, what is sure: enters *)
Definition pair_enters : test :=
  And (Given "sure") (Given "inside").

(** sweep.Sweep.of_pairs, what is sure: path *)
Definition pair_path : test :=
  And (Given "sure") (Given "inside").

(** sweep.Sweep.of_pairs, what is in doubt: stays *)
Definition pair_open_stays : test :=
  And (Not (Or (And (Given "sure") (Given "inside")) (Less (Var "most") (Var "nearness")))) (Not
    (Given "outside")).

(** sweep.Sweep.of_pairs, what is in doubt: path *)
Definition pair_open_path : test :=
  Not (And (Given "sure") (Given "inside")).

(** boxes.InstanceBoxes.hidden *)
Definition hidden_instance : test :=
  Less (Var "nearest") (Var "farthest").

(** sweep.Sweep.not_hidden *)
Definition not_hidden_box : test :=
  Not (Less (Var "nearest") (Var "farthest")).

(** depth_buffer.DepthBuffer.not_hidden *)
Definition not_hidden_fragment : test :=
  Not (Less (Var "nearest") (Var "nearness")).

(** quotient.two_sum: high *)
Definition two_sum_high : expr :=
  Add (Var "a") (Var "b").

(** quotient.two_sum: low *)
Definition two_sum_low : expr :=
  let x1 := Add (Var "a") (Var "b") in
  let x2 := Sub x1 (Var "a") in
  Add (Sub (Var "a") (Sub x1 x2)) (Sub (Var "b") x2).

(** quotient.halves: high *)
Definition halves_high : expr :=
  let x1 := Mul (Var "unit") (Num 3 26) in
  Sub (Add (Var "v") x1) x1.

(** quotient.halves: low *)
Definition halves_low : expr :=
  let x1 := Mul (Var "unit") (Num 3 26) in
  Sub (Var "v") (Sub (Add (Var "v") x1) x1).

(** quotient.highest *)
Definition highest : expr :=
  Keep 26 (Var "a").

(** quotient.power_above *)
Definition power_above : expr :=
  Mul (Keep 1 (Abs (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))))) (Num 1 1).

(** quotient._error *)
Definition product_error : expr :=
  let x1 := Mul (Var "unit") (Var "size") in
  Where (And (Less (Num 1 (-950)) x1) (Less x1 (Num 1 1000))) (Mul x1 (Num 1 (-72))) Inf.

(** quotient._dot, of a sum of two floats: high *)
Definition product_high : expr :=
  let x1 := Mul (Var "unit") (Num 3 26) in
  Add (Add (Mul (Sub (Add (Var "vx") x1) x1) (Var "hx")) (Mul (Sub (Add (Var "vy") x1) x1)
    (Var "hy"))) (Mul (Sub (Add (Var "vz") x1) x1) (Var "hz")).

(** quotient._dot, of a sum of two floats: low *)
Definition product_low : expr :=
  let x1 := Mul (Var "unit") (Num 3 26) in
  let x2 := Sub (Add (Var "vx") x1) x1 in
  let x3 := Sub (Add (Var "vy") x1) x1 in
  let x4 := Sub (Add (Var "vz") x1) x1 in
  Add (Add (Add (Mul (Var "lx") x2) (Mul (Add (Var "hx") (Var "lx")) (Add (Sub (Var "vx") x2)
    (Var "v2x")))) (Add (Mul (Var "ly") x3) (Mul (Add (Var "hy") (Var "ly")) (Add (Sub (Var "vy")
    x3) (Var "v2y"))))) (Add (Mul (Var "lz") x4) (Mul (Add (Var "hz") (Var "lz")) (Add (Sub
    (Var "vz") x4) (Var "v2z")))).

(** quotient._dot, of one float: high *)
Definition product_of_one_high : expr :=
  let x1 := Mul (Var "unit") (Num 3 26) in
  Add (Add (Mul (Sub (Add (Var "vx") x1) x1) (Var "hx")) (Mul (Sub (Add (Var "vy") x1) x1)
    (Var "hy"))) (Mul (Sub (Add (Var "vz") x1) x1) (Var "hz")).

(** quotient._dot, of one float: low *)
Definition product_of_one_low : expr :=
  let x1 := Mul (Var "unit") (Num 3 26) in
  let x2 := Sub (Add (Var "vx") x1) x1 in
  let x3 := Sub (Add (Var "vy") x1) x1 in
  let x4 := Sub (Add (Var "vz") x1) x1 in
  Add (Add (Add (Mul (Var "lx") x2) (Mul (Add (Var "hx") (Var "lx")) (Add (Sub (Var "vx") x2)
    (Num 0 0)))) (Add (Mul (Var "ly") x3) (Mul (Add (Var "hy") (Var "ly")) (Add (Sub (Var "vy") x3)
    (Num 0 0))))) (Add (Mul (Var "lz") x4) (Mul (Add (Var "hz") (Var "lz")) (Add (Sub (Var "vz") x4)
    (Num 0 0)))).

(** quotient._cross: x *)
Definition cross_x : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "ux")) (Abs (Var "uy"))) (Abs (Var "uz")))))
    (Num 1 1)) (Num 3 26) in
  let x2 := Sub (Add (Var "uy") x1) x1 in
  let x3 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz")))))
    (Num 1 1)) (Num 3 26) in
  let x4 := Sub (Add (Var "vz") x3) x3 in
  let x5 := Sub (Add (Var "uz") x1) x1 in
  let x6 := Sub (Add (Var "vy") x3) x3 in
  Add (Sub (Mul x2 x4) (Mul x5 x6)) (Add (Sub (Mul x2 (Add (Sub (Var "vz") x4) (Var "v2z"))) (Mul x5
    (Add (Sub (Var "vy") x6) (Var "v2y")))) (Sub (Mul (Add (Sub (Var "uy") x2) (Var "u2y"))
    (Var "vz")) (Mul (Add (Sub (Var "uz") x5) (Var "u2z")) (Var "vy")))).

(** quotient._cross: y *)
Definition cross_y : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "ux")) (Abs (Var "uy"))) (Abs (Var "uz")))))
    (Num 1 1)) (Num 3 26) in
  let x2 := Sub (Add (Var "uz") x1) x1 in
  let x3 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz")))))
    (Num 1 1)) (Num 3 26) in
  let x4 := Sub (Add (Var "vx") x3) x3 in
  let x5 := Sub (Add (Var "ux") x1) x1 in
  let x6 := Sub (Add (Var "vz") x3) x3 in
  Add (Sub (Mul x2 x4) (Mul x5 x6)) (Add (Sub (Mul x2 (Add (Sub (Var "vx") x4) (Var "v2x"))) (Mul x5
    (Add (Sub (Var "vz") x6) (Var "v2z")))) (Sub (Mul (Add (Sub (Var "uz") x2) (Var "u2z"))
    (Var "vx")) (Mul (Add (Sub (Var "ux") x5) (Var "u2x")) (Var "vz")))).

(** quotient._cross: z *)
Definition cross_z : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "ux")) (Abs (Var "uy"))) (Abs (Var "uz")))))
    (Num 1 1)) (Num 3 26) in
  let x2 := Sub (Add (Var "ux") x1) x1 in
  let x3 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz")))))
    (Num 1 1)) (Num 3 26) in
  let x4 := Sub (Add (Var "vy") x3) x3 in
  let x5 := Sub (Add (Var "uy") x1) x1 in
  let x6 := Sub (Add (Var "vx") x3) x3 in
  Add (Sub (Mul x2 x4) (Mul x5 x6)) (Add (Sub (Mul x2 (Add (Sub (Var "vy") x4) (Var "v2y"))) (Mul x5
    (Add (Sub (Var "vx") x6) (Var "v2x")))) (Sub (Mul (Add (Sub (Var "ux") x2) (Var "u2x"))
    (Var "vy")) (Mul (Add (Sub (Var "uy") x5) (Var "u2y")) (Var "vx")))).

(** quotient._cross: low x *)
Definition cross_low_x : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "ux")) (Abs (Var "uy"))) (Abs (Var "uz")))))
    (Num 1 1)) (Num 3 26) in
  let x2 := Sub (Add (Var "uy") x1) x1 in
  let x3 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz")))))
    (Num 1 1)) (Num 3 26) in
  let x4 := Sub (Add (Var "vz") x3) x3 in
  let x5 := Sub (Add (Var "uz") x1) x1 in
  let x6 := Sub (Add (Var "vy") x3) x3 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Add (Sub (Mul x2 (Add (Sub (Var "vz") x4) (Var "v2z"))) (Mul x5 (Add (Sub (Var "vy") x6)
    (Var "v2y")))) (Sub (Mul (Add (Sub (Var "uy") x2) (Var "u2y")) (Var "vz")) (Mul (Add (Sub
    (Var "uz") x5) (Var "u2z")) (Var "vy"))) in
  let x9 := Add x7 x8 in
  let x10 := Sub x9 x7 in
  Add (Sub x7 (Sub x9 x10)) (Sub x8 x10).

(** quotient._cross: low y *)
Definition cross_low_y : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "ux")) (Abs (Var "uy"))) (Abs (Var "uz")))))
    (Num 1 1)) (Num 3 26) in
  let x2 := Sub (Add (Var "uz") x1) x1 in
  let x3 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz")))))
    (Num 1 1)) (Num 3 26) in
  let x4 := Sub (Add (Var "vx") x3) x3 in
  let x5 := Sub (Add (Var "ux") x1) x1 in
  let x6 := Sub (Add (Var "vz") x3) x3 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Add (Sub (Mul x2 (Add (Sub (Var "vx") x4) (Var "v2x"))) (Mul x5 (Add (Sub (Var "vz") x6)
    (Var "v2z")))) (Sub (Mul (Add (Sub (Var "uz") x2) (Var "u2z")) (Var "vx")) (Mul (Add (Sub
    (Var "ux") x5) (Var "u2x")) (Var "vz"))) in
  let x9 := Add x7 x8 in
  let x10 := Sub x9 x7 in
  Add (Sub x7 (Sub x9 x10)) (Sub x8 x10).

(** quotient._cross: low z *)
Definition cross_low_z : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "ux")) (Abs (Var "uy"))) (Abs (Var "uz")))))
    (Num 1 1)) (Num 3 26) in
  let x2 := Sub (Add (Var "ux") x1) x1 in
  let x3 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz")))))
    (Num 1 1)) (Num 3 26) in
  let x4 := Sub (Add (Var "vy") x3) x3 in
  let x5 := Sub (Add (Var "uy") x1) x1 in
  let x6 := Sub (Add (Var "vx") x3) x3 in
  let x7 := Sub (Mul x2 x4) (Mul x5 x6) in
  let x8 := Add (Sub (Mul x2 (Add (Sub (Var "vy") x4) (Var "v2y"))) (Mul x5 (Add (Sub (Var "vx") x6)
    (Var "v2x")))) (Sub (Mul (Add (Sub (Var "ux") x2) (Var "u2x")) (Var "vy")) (Mul (Add (Sub
    (Var "uy") x5) (Var "u2y")) (Var "vx"))) in
  let x9 := Add x7 x8 in
  let x10 := Sub x9 x7 in
  Add (Sub x7 (Sub x9 x10)) (Sub x8 x10).

(** quotient._cross: M *)
Definition cross_M : expr :=
  Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "ux")) (Abs (Var "uy"))) (Abs (Var "uz"))))) (Num 1 1))
    (Mul (Keep 1 (Abs (Max (Max (Abs (Var "vx")) (Abs (Var "vy"))) (Abs (Var "vz"))))) (Num 1 1)).

(** quotient.Quotients.of, a triangle: x *)
Definition normal_x : expr :=
  let x1 := Neg (Var "ay") in
  let x2 := Add (Var "by") x1 in
  let x3 := Neg (Var "ax") in
  let x4 := Neg (Var "az") in
  let x5 := Add (Var "bz") x4 in
  let x6 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Add (Var "bx") x3)) (Abs x2)) (Abs x5))))
    (Num 1 1)) (Num 3 26) in
  let x7 := Sub (Add x2 x6) x6 in
  let x8 := Add (Var "cz") x4 in
  let x9 := Add (Var "cy") x1 in
  let x10 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Add (Var "cx") x3)) (Abs x9)) (Abs x8))))
    (Num 1 1)) (Num 3 26) in
  let x11 := Sub (Add x8 x10) x10 in
  let x12 := Sub (Add x5 x6) x6 in
  let x13 := Sub (Add x9 x10) x10 in
  let x14 := Sub x8 (Var "cz") in
  let x15 := Sub x9 (Var "cy") in
  let x16 := Sub x2 (Var "by") in
  let x17 := Sub x5 (Var "bz") in
  Add (Sub (Mul x7 x11) (Mul x12 x13)) (Add (Sub (Mul x7 (Add (Sub x8 x11) (Add (Sub (Var "cz") (Sub
    x8 x14)) (Sub x4 x14)))) (Mul x12 (Add (Sub x9 x13) (Add (Sub (Var "cy") (Sub x9 x15)) (Sub x1
    x15))))) (Sub (Mul (Add (Sub x2 x7) (Add (Sub (Var "by") (Sub x2 x16)) (Sub x1 x16))) x8) (Mul
    (Add (Sub x5 x12) (Add (Sub (Var "bz") (Sub x5 x17)) (Sub x4 x17))) x9))).

(** quotient.Quotients.of, a triangle: y *)
Definition normal_y : expr :=
  let x1 := Neg (Var "az") in
  let x2 := Add (Var "bz") x1 in
  let x3 := Neg (Var "ax") in
  let x4 := Add (Var "bx") x3 in
  let x5 := Neg (Var "ay") in
  let x6 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x4) (Abs (Add (Var "by") x5))) (Abs x2))))
    (Num 1 1)) (Num 3 26) in
  let x7 := Sub (Add x2 x6) x6 in
  let x8 := Add (Var "cx") x3 in
  let x9 := Add (Var "cz") x1 in
  let x10 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x8) (Abs (Add (Var "cy") x5))) (Abs x9))))
    (Num 1 1)) (Num 3 26) in
  let x11 := Sub (Add x8 x10) x10 in
  let x12 := Sub (Add x4 x6) x6 in
  let x13 := Sub (Add x9 x10) x10 in
  let x14 := Sub x8 (Var "cx") in
  let x15 := Sub x9 (Var "cz") in
  let x16 := Sub x2 (Var "bz") in
  let x17 := Sub x4 (Var "bx") in
  Add (Sub (Mul x7 x11) (Mul x12 x13)) (Add (Sub (Mul x7 (Add (Sub x8 x11) (Add (Sub (Var "cx") (Sub
    x8 x14)) (Sub x3 x14)))) (Mul x12 (Add (Sub x9 x13) (Add (Sub (Var "cz") (Sub x9 x15)) (Sub x1
    x15))))) (Sub (Mul (Add (Sub x2 x7) (Add (Sub (Var "bz") (Sub x2 x16)) (Sub x1 x16))) x8) (Mul
    (Add (Sub x4 x12) (Add (Sub (Var "bx") (Sub x4 x17)) (Sub x3 x17))) x9))).

(** quotient.Quotients.of, a triangle: z *)
Definition normal_z : expr :=
  let x1 := Neg (Var "ax") in
  let x2 := Add (Var "bx") x1 in
  let x3 := Neg (Var "ay") in
  let x4 := Add (Var "by") x3 in
  let x5 := Neg (Var "az") in
  let x6 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x2) (Abs x4)) (Abs (Add (Var "bz") x5)))))
    (Num 1 1)) (Num 3 26) in
  let x7 := Sub (Add x2 x6) x6 in
  let x8 := Add (Var "cy") x3 in
  let x9 := Add (Var "cx") x1 in
  let x10 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x9) (Abs x8)) (Abs (Add (Var "cz") x5)))))
    (Num 1 1)) (Num 3 26) in
  let x11 := Sub (Add x8 x10) x10 in
  let x12 := Sub (Add x4 x6) x6 in
  let x13 := Sub (Add x9 x10) x10 in
  let x14 := Sub x8 (Var "cy") in
  let x15 := Sub x9 (Var "cx") in
  let x16 := Sub x2 (Var "bx") in
  let x17 := Sub x4 (Var "by") in
  Add (Sub (Mul x7 x11) (Mul x12 x13)) (Add (Sub (Mul x7 (Add (Sub x8 x11) (Add (Sub (Var "cy") (Sub
    x8 x14)) (Sub x3 x14)))) (Mul x12 (Add (Sub x9 x13) (Add (Sub (Var "cx") (Sub x9 x15)) (Sub x1
    x15))))) (Sub (Mul (Add (Sub x2 x7) (Add (Sub (Var "bx") (Sub x2 x16)) (Sub x1 x16))) x8) (Mul
    (Add (Sub x4 x12) (Add (Sub (Var "by") (Sub x4 x17)) (Sub x3 x17))) x9))).

(** quotient.Quotients.of, a triangle: low x *)
Definition normal_low_x : expr :=
  let x1 := Neg (Var "ay") in
  let x2 := Add (Var "by") x1 in
  let x3 := Neg (Var "ax") in
  let x4 := Neg (Var "az") in
  let x5 := Add (Var "bz") x4 in
  let x6 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Add (Var "bx") x3)) (Abs x2)) (Abs x5))))
    (Num 1 1)) (Num 3 26) in
  let x7 := Sub (Add x2 x6) x6 in
  let x8 := Add (Var "cz") x4 in
  let x9 := Add (Var "cy") x1 in
  let x10 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Add (Var "cx") x3)) (Abs x9)) (Abs x8))))
    (Num 1 1)) (Num 3 26) in
  let x11 := Sub (Add x8 x10) x10 in
  let x12 := Sub (Add x5 x6) x6 in
  let x13 := Sub (Add x9 x10) x10 in
  let x14 := Sub (Mul x7 x11) (Mul x12 x13) in
  let x15 := Sub x8 (Var "cz") in
  let x16 := Sub x9 (Var "cy") in
  let x17 := Sub x2 (Var "by") in
  let x18 := Sub x5 (Var "bz") in
  let x19 := Add (Sub (Mul x7 (Add (Sub x8 x11) (Add (Sub (Var "cz") (Sub x8 x15)) (Sub x4 x15))))
    (Mul x12 (Add (Sub x9 x13) (Add (Sub (Var "cy") (Sub x9 x16)) (Sub x1 x16))))) (Sub (Mul (Add
    (Sub x2 x7) (Add (Sub (Var "by") (Sub x2 x17)) (Sub x1 x17))) x8) (Mul (Add (Sub x5 x12) (Add
    (Sub (Var "bz") (Sub x5 x18)) (Sub x4 x18))) x9)) in
  let x20 := Add x14 x19 in
  let x21 := Sub x20 x14 in
  Add (Sub x14 (Sub x20 x21)) (Sub x19 x21).

(** quotient.Quotients.of, a triangle: low y *)
Definition normal_low_y : expr :=
  let x1 := Neg (Var "az") in
  let x2 := Add (Var "bz") x1 in
  let x3 := Neg (Var "ax") in
  let x4 := Add (Var "bx") x3 in
  let x5 := Neg (Var "ay") in
  let x6 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x4) (Abs (Add (Var "by") x5))) (Abs x2))))
    (Num 1 1)) (Num 3 26) in
  let x7 := Sub (Add x2 x6) x6 in
  let x8 := Add (Var "cx") x3 in
  let x9 := Add (Var "cz") x1 in
  let x10 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x8) (Abs (Add (Var "cy") x5))) (Abs x9))))
    (Num 1 1)) (Num 3 26) in
  let x11 := Sub (Add x8 x10) x10 in
  let x12 := Sub (Add x4 x6) x6 in
  let x13 := Sub (Add x9 x10) x10 in
  let x14 := Sub (Mul x7 x11) (Mul x12 x13) in
  let x15 := Sub x8 (Var "cx") in
  let x16 := Sub x9 (Var "cz") in
  let x17 := Sub x2 (Var "bz") in
  let x18 := Sub x4 (Var "bx") in
  let x19 := Add (Sub (Mul x7 (Add (Sub x8 x11) (Add (Sub (Var "cx") (Sub x8 x15)) (Sub x3 x15))))
    (Mul x12 (Add (Sub x9 x13) (Add (Sub (Var "cz") (Sub x9 x16)) (Sub x1 x16))))) (Sub (Mul (Add
    (Sub x2 x7) (Add (Sub (Var "bz") (Sub x2 x17)) (Sub x1 x17))) x8) (Mul (Add (Sub x4 x12) (Add
    (Sub (Var "bx") (Sub x4 x18)) (Sub x3 x18))) x9)) in
  let x20 := Add x14 x19 in
  let x21 := Sub x20 x14 in
  Add (Sub x14 (Sub x20 x21)) (Sub x19 x21).

(** quotient.Quotients.of, a triangle: low z *)
Definition normal_low_z : expr :=
  let x1 := Neg (Var "ax") in
  let x2 := Add (Var "bx") x1 in
  let x3 := Neg (Var "ay") in
  let x4 := Add (Var "by") x3 in
  let x5 := Neg (Var "az") in
  let x6 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x2) (Abs x4)) (Abs (Add (Var "bz") x5)))))
    (Num 1 1)) (Num 3 26) in
  let x7 := Sub (Add x2 x6) x6 in
  let x8 := Add (Var "cy") x3 in
  let x9 := Add (Var "cx") x1 in
  let x10 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x9) (Abs x8)) (Abs (Add (Var "cz") x5)))))
    (Num 1 1)) (Num 3 26) in
  let x11 := Sub (Add x8 x10) x10 in
  let x12 := Sub (Add x4 x6) x6 in
  let x13 := Sub (Add x9 x10) x10 in
  let x14 := Sub (Mul x7 x11) (Mul x12 x13) in
  let x15 := Sub x8 (Var "cy") in
  let x16 := Sub x9 (Var "cx") in
  let x17 := Sub x2 (Var "bx") in
  let x18 := Sub x4 (Var "by") in
  let x19 := Add (Sub (Mul x7 (Add (Sub x8 x11) (Add (Sub (Var "cy") (Sub x8 x15)) (Sub x3 x15))))
    (Mul x12 (Add (Sub x9 x13) (Add (Sub (Var "cx") (Sub x9 x16)) (Sub x1 x16))))) (Sub (Mul (Add
    (Sub x2 x7) (Add (Sub (Var "bx") (Sub x2 x17)) (Sub x1 x17))) x8) (Mul (Add (Sub x4 x12) (Add
    (Sub (Var "by") (Sub x4 x18)) (Sub x3 x18))) x9)) in
  let x20 := Add x14 x19 in
  let x21 := Sub x20 x14 in
  Add (Sub x14 (Sub x20 x21)) (Sub x19 x21).

(** quotient.Quotients.of, a triangle: M *)
Definition normal_M : expr :=
  let x1 := Neg (Var "ax") in
  let x2 := Neg (Var "ay") in
  let x3 := Neg (Var "az") in
  let x4 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Add (Var "bx") x1)) (Abs (Add (Var "by") x2)))
    (Abs (Add (Var "bz") x3))))) (Num 1 1)) (Mul (Keep 1 (Abs (Max (Max (Abs (Add (Var "cx") x1))
    (Abs (Add (Var "cy") x2))) (Abs (Add (Var "cz") x3))))) (Num 1 1)) in
  Where (Less (Num 1 (-950)) x4) x4 Inf.

(** quotient.Quotients, rays from one point *)
Definition unit_from_point : expr :=
  Mul (Keep 1 (Abs (Max (Max (Abs (Abs (Var "dx"))) (Abs (Abs (Var "dy")))) (Abs (Abs
    (Var "dz")))))) (Num 1 1).

(** quotient.Quotients._enter, rays from one point: hx *)
Definition table_from_point_hx : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Sub (Add (Var "nx") x1) x1.

(** quotient.Quotients._enter, rays from one point: hy *)
Definition table_from_point_hy : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Sub (Add (Var "ny") x1) x1.

(** quotient.Quotients._enter, rays from one point: hz *)
Definition table_from_point_hz : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Sub (Add (Var "nz") x1) x1.

(** quotient.Quotients._enter, rays from one point: lx *)
Definition table_from_point_lx : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Add (Sub (Var "nx") (Sub (Add (Var "nx") x1) x1)) (Var "n2x").

(** quotient.Quotients._enter, rays from one point: ly *)
Definition table_from_point_ly : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Add (Sub (Var "ny") (Sub (Add (Var "ny") x1) x1)) (Var "n2y").

(** quotient.Quotients._enter, rays from one point: lz *)
Definition table_from_point_lz : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Add (Sub (Var "nz") (Sub (Add (Var "nz") x1) x1)) (Var "n2z").

(** quotient.Quotients._enter, rays from one point: T1 *)
Definition table_from_point_T1 : expr :=
  let x1 := Neg (Var "ox") in
  let x2 := Add (Var "px") x1 in
  let x3 := Neg (Var "oy") in
  let x4 := Add (Var "py") x3 in
  let x5 := Neg (Var "oz") in
  let x6 := Add (Var "pz") x5 in
  let x7 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x2) (Abs x4)) (Abs x6)))) (Num 1 1)) (Num 3 26) in
  let x8 := Sub (Add x2 x7) x7 in
  let x9 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  let x10 := Sub (Add (Var "nx") x9) x9 in
  let x11 := Sub (Add x4 x7) x7 in
  let x12 := Sub (Add (Var "ny") x9) x9 in
  let x13 := Sub (Add x6 x7) x7 in
  let x14 := Sub (Add (Var "nz") x9) x9 in
  let x15 := Add (Sub (Var "nx") x10) (Var "n2x") in
  let x16 := Sub x2 (Var "px") in
  let x17 := Add (Sub (Var "ny") x12) (Var "n2y") in
  let x18 := Sub x4 (Var "py") in
  let x19 := Add (Sub (Var "nz") x14) (Var "n2z") in
  let x20 := Sub x6 (Var "pz") in
  Add (Add (Add (Mul x8 x10) (Mul x11 x12)) (Mul x13 x14)) (Add (Add (Add (Mul x15 x8) (Mul (Add x10
    x15) (Add (Sub x2 x8) (Add (Sub (Var "px") (Sub x2 x16)) (Sub x1 x16))))) (Add (Mul x17 x11)
    (Mul (Add x12 x17) (Add (Sub x4 x11) (Add (Sub (Var "py") (Sub x4 x18)) (Sub x3 x18)))))) (Add
    (Mul x19 x13) (Mul (Add x14 x19) (Add (Sub x6 x13) (Add (Sub (Var "pz") (Sub x6 x20)) (Sub x5
    x20)))))).

(** quotient.Quotients._enter, rays from one point: T2 *)
Definition table_from_point_T2 : expr :=
  let x1 := Neg (Var "ox") in
  let x2 := Add (Var "px") x1 in
  let x3 := Neg (Var "oy") in
  let x4 := Add (Var "py") x3 in
  let x5 := Neg (Var "oz") in
  let x6 := Add (Var "pz") x5 in
  let x7 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x2) (Abs x4)) (Abs x6)))) (Num 1 1)) (Num 3 26) in
  let x8 := Sub (Add x2 x7) x7 in
  let x9 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  let x10 := Sub (Add (Var "nx") x9) x9 in
  let x11 := Sub (Add x4 x7) x7 in
  let x12 := Sub (Add (Var "ny") x9) x9 in
  let x13 := Sub (Add x6 x7) x7 in
  let x14 := Sub (Add (Var "nz") x9) x9 in
  let x15 := Add (Add (Mul x8 x10) (Mul x11 x12)) (Mul x13 x14) in
  let x16 := Add (Sub (Var "nx") x10) (Var "n2x") in
  let x17 := Sub x2 (Var "px") in
  let x18 := Add (Sub (Var "ny") x12) (Var "n2y") in
  let x19 := Sub x4 (Var "py") in
  let x20 := Add (Sub (Var "nz") x14) (Var "n2z") in
  let x21 := Sub x6 (Var "pz") in
  let x22 := Add (Add (Add (Mul x16 x8) (Mul (Add x10 x16) (Add (Sub x2 x8) (Add (Sub (Var "px")
    (Sub x2 x17)) (Sub x1 x17))))) (Add (Mul x18 x11) (Mul (Add x12 x18) (Add (Sub x4 x11) (Add (Sub
    (Var "py") (Sub x4 x19)) (Sub x3 x19)))))) (Add (Mul x20 x13) (Mul (Add x14 x20) (Add (Sub x6
    x13) (Add (Sub (Var "pz") (Sub x6 x21)) (Sub x5 x21))))) in
  let x23 := Add x15 x22 in
  let x24 := Sub x23 x15 in
  Add (Sub x15 (Sub x23 x24)) (Sub x22 x24).

(** quotient.Quotients._enter, rays from one point: ET *)
Definition table_from_point_ET : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Add (Var "px") (Neg (Var "ox")))) (Abs (Add
    (Var "py") (Neg (Var "oy"))))) (Abs (Add (Var "pz") (Neg (Var "oz"))))))) (Num 1 1)) (Add (Mul
    (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz"))))) (Num 1 1)) (Mul
    (Num 3 0) (Var "M"))) in
  Where (And (Less (Num 1 (-950)) x1) (Less x1 (Num 1 1000))) (Mul x1 (Num 1 (-72))) Inf.

(** quotient.Quotients._enter, rays from one point: ED *)
Definition table_from_point_ED : expr :=
  let x1 := Mul (Var "unit") (Add (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny")))
    (Abs (Var "nz"))))) (Num 1 1)) (Mul (Num 3 0) (Var "M"))) in
  Where (And (Less (Num 1 (-950)) x1) (Less x1 (Num 1 1000))) (Mul x1 (Num 1 (-72))) Inf.

(** quotient.Quotients.meet, rays from one point: T1 *)
Definition meet_from_point_T1 : expr :=
  Var "T1".

(** quotient.Quotients.meet, rays from one point: T2 *)
Definition meet_from_point_T2 : expr :=
  Var "T2".

(** quotient.Quotients.meet, rays from one point: ET *)
Definition meet_from_point_ET : expr :=
  Var "ET".

(** quotient.Quotients.meet, rays from one point: D1 *)
Definition meet_from_point_D1 : expr :=
  let x1 := Mul (Var "unit") (Num 3 26) in
  Add (Add (Mul (Sub (Add (Var "dx") x1) x1) (Var "hx")) (Mul (Sub (Add (Var "dy") x1) x1)
    (Var "hy"))) (Mul (Sub (Add (Var "dz") x1) x1) (Var "hz")).

(** quotient.Quotients.meet, rays from one point: D2 *)
Definition meet_from_point_D2 : expr :=
  let x1 := Mul (Var "unit") (Num 3 26) in
  let x2 := Sub (Add (Var "dx") x1) x1 in
  let x3 := Sub (Add (Var "dy") x1) x1 in
  let x4 := Sub (Add (Var "dz") x1) x1 in
  Add (Add (Add (Mul (Var "lx") x2) (Mul (Add (Var "hx") (Var "lx")) (Add (Sub (Var "dx") x2)
    (Num 0 0)))) (Add (Mul (Var "ly") x3) (Mul (Add (Var "hy") (Var "ly")) (Add (Sub (Var "dy") x3)
    (Num 0 0))))) (Add (Mul (Var "lz") x4) (Mul (Add (Var "hz") (Var "lz")) (Add (Sub (Var "dz") x4)
    (Num 0 0)))).

(** quotient.Quotients.meet, rays from one point: ED *)
Definition meet_from_point_ED : expr :=
  Var "ED".

(** quotient.Quotients._enter, parallel rays: hx *)
Definition table_parallel_hx : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Sub (Add (Var "nx") x1) x1.

(** quotient.Quotients._enter, parallel rays: hy *)
Definition table_parallel_hy : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Sub (Add (Var "ny") x1) x1.

(** quotient.Quotients._enter, parallel rays: hz *)
Definition table_parallel_hz : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Sub (Add (Var "nz") x1) x1.

(** quotient.Quotients._enter, parallel rays: lx *)
Definition table_parallel_lx : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Add (Sub (Var "nx") (Sub (Add (Var "nx") x1) x1)) (Var "n2x").

(** quotient.Quotients._enter, parallel rays: ly *)
Definition table_parallel_ly : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Add (Sub (Var "ny") (Sub (Add (Var "ny") x1) x1)) (Var "n2y").

(** quotient.Quotients._enter, parallel rays: lz *)
Definition table_parallel_lz : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Add (Sub (Var "nz") (Sub (Add (Var "nz") x1) x1)) (Var "n2z").

(** quotient.Quotients._enter, parallel rays: T1 *)
Definition table_parallel_T1 : expr :=
  let x1 := Neg (Var "ox") in
  let x2 := Add (Var "px") x1 in
  let x3 := Neg (Var "oy") in
  let x4 := Add (Var "py") x3 in
  let x5 := Neg (Var "oz") in
  let x6 := Add (Var "pz") x5 in
  let x7 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x2) (Abs x4)) (Abs x6)))) (Num 1 1)) (Num 3 26) in
  let x8 := Sub (Add x2 x7) x7 in
  let x9 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  let x10 := Sub (Add (Var "nx") x9) x9 in
  let x11 := Sub (Add x4 x7) x7 in
  let x12 := Sub (Add (Var "ny") x9) x9 in
  let x13 := Sub (Add x6 x7) x7 in
  let x14 := Sub (Add (Var "nz") x9) x9 in
  let x15 := Add (Sub (Var "nx") x10) (Var "n2x") in
  let x16 := Sub x2 (Var "px") in
  let x17 := Add (Sub (Var "ny") x12) (Var "n2y") in
  let x18 := Sub x4 (Var "py") in
  let x19 := Add (Sub (Var "nz") x14) (Var "n2z") in
  let x20 := Sub x6 (Var "pz") in
  Add (Add (Add (Mul x8 x10) (Mul x11 x12)) (Mul x13 x14)) (Add (Add (Add (Mul x15 x8) (Mul (Add x10
    x15) (Add (Sub x2 x8) (Add (Sub (Var "px") (Sub x2 x16)) (Sub x1 x16))))) (Add (Mul x17 x11)
    (Mul (Add x12 x17) (Add (Sub x4 x11) (Add (Sub (Var "py") (Sub x4 x18)) (Sub x3 x18)))))) (Add
    (Mul x19 x13) (Mul (Add x14 x19) (Add (Sub x6 x13) (Add (Sub (Var "pz") (Sub x6 x20)) (Sub x5
    x20)))))).

(** quotient.Quotients._enter, parallel rays: T2 *)
Definition table_parallel_T2 : expr :=
  let x1 := Neg (Var "ox") in
  let x2 := Add (Var "px") x1 in
  let x3 := Neg (Var "oy") in
  let x4 := Add (Var "py") x3 in
  let x5 := Neg (Var "oz") in
  let x6 := Add (Var "pz") x5 in
  let x7 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x2) (Abs x4)) (Abs x6)))) (Num 1 1)) (Num 3 26) in
  let x8 := Sub (Add x2 x7) x7 in
  let x9 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  let x10 := Sub (Add (Var "nx") x9) x9 in
  let x11 := Sub (Add x4 x7) x7 in
  let x12 := Sub (Add (Var "ny") x9) x9 in
  let x13 := Sub (Add x6 x7) x7 in
  let x14 := Sub (Add (Var "nz") x9) x9 in
  let x15 := Add (Add (Mul x8 x10) (Mul x11 x12)) (Mul x13 x14) in
  let x16 := Add (Sub (Var "nx") x10) (Var "n2x") in
  let x17 := Sub x2 (Var "px") in
  let x18 := Add (Sub (Var "ny") x12) (Var "n2y") in
  let x19 := Sub x4 (Var "py") in
  let x20 := Add (Sub (Var "nz") x14) (Var "n2z") in
  let x21 := Sub x6 (Var "pz") in
  let x22 := Add (Add (Add (Mul x16 x8) (Mul (Add x10 x16) (Add (Sub x2 x8) (Add (Sub (Var "px")
    (Sub x2 x17)) (Sub x1 x17))))) (Add (Mul x18 x11) (Mul (Add x12 x18) (Add (Sub x4 x11) (Add (Sub
    (Var "py") (Sub x4 x19)) (Sub x3 x19)))))) (Add (Mul x20 x13) (Mul (Add x14 x20) (Add (Sub x6
    x13) (Add (Sub (Var "pz") (Sub x6 x21)) (Sub x5 x21))))) in
  let x23 := Add x15 x22 in
  let x24 := Sub x23 x15 in
  Add (Sub x15 (Sub x23 x24)) (Sub x22 x24).

(** quotient.Quotients._enter, parallel rays: ET *)
Definition table_parallel_ET : expr :=
  let x1 := Add (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Mul (Num 3 0) (Var "M")) in
  let x2 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Add (Var "px") (Neg (Var "ox")))) (Abs (Add
    (Var "py") (Neg (Var "oy"))))) (Abs (Add (Var "pz") (Neg (Var "oz"))))))) (Num 1 1)) x1 in
  let x3 := Mul (Var "unit") x1 in
  Add (Where (And (Less (Num 1 (-950)) x2) (Less x2 (Num 1 1000))) (Mul x2 (Num 1 (-72))) Inf)
    (Where (And (Less (Num 1 (-950)) x3) (Less x3 (Num 1 1000))) (Mul x3 (Num 1 (-72))) Inf).

(** quotient.Quotients._enter, parallel rays: D1 *)
Definition table_parallel_D1 : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "dx")) (Abs (Var "dy"))) (Abs (Var "dz")))))
    (Num 1 1)) (Num 3 26) in
  let x2 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Add (Add (Mul (Sub (Add (Var "dx") x1) x1) (Sub (Add (Var "nx") x2) x2)) (Mul (Sub (Add (Var "dy")
    x1) x1) (Sub (Add (Var "ny") x2) x2))) (Mul (Sub (Add (Var "dz") x1) x1) (Sub (Add (Var "nz")
    x2) x2)).

(** quotient.Quotients._enter, parallel rays: D2 *)
Definition table_parallel_D2 : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  let x2 := Sub (Add (Var "nx") x1) x1 in
  let x3 := Add (Sub (Var "nx") x2) (Var "n2x") in
  let x4 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "dx")) (Abs (Var "dy"))) (Abs (Var "dz")))))
    (Num 1 1)) (Num 3 26) in
  let x5 := Sub (Add (Var "dx") x4) x4 in
  let x6 := Sub (Add (Var "ny") x1) x1 in
  let x7 := Add (Sub (Var "ny") x6) (Var "n2y") in
  let x8 := Sub (Add (Var "dy") x4) x4 in
  let x9 := Sub (Add (Var "nz") x1) x1 in
  let x10 := Add (Sub (Var "nz") x9) (Var "n2z") in
  let x11 := Sub (Add (Var "dz") x4) x4 in
  Add (Add (Add (Mul x3 x5) (Mul (Add x2 x3) (Add (Sub (Var "dx") x5) (Num 0 0)))) (Add (Mul x7 x8)
    (Mul (Add x6 x7) (Add (Sub (Var "dy") x8) (Num 0 0))))) (Add (Mul x10 x11) (Mul (Add x9 x10)
    (Add (Sub (Var "dz") x11) (Num 0 0)))).

(** quotient.Quotients._enter, parallel rays: ED *)
Definition table_parallel_ED : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "dx")) (Abs (Var "dy"))) (Abs (Var "dz")))))
    (Num 1 1)) (Add (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs
    (Var "nz"))))) (Num 1 1)) (Mul (Num 3 0) (Var "M"))) in
  Where (And (Less (Num 1 (-950)) x1) (Less x1 (Num 1 1000))) (Mul x1 (Num 1 (-72))) Inf.

(** quotient.Quotients.meet, parallel rays: T1 *)
Definition meet_parallel_T1 : expr :=
  let x1 := Mul (Var "unit") (Num 3 26) in
  Add (Var "T1") (Neg (Add (Add (Mul (Sub (Add (Add (Var "qx") (Neg (Var "ox"))) x1) x1) (Var "hx"))
    (Mul (Sub (Add (Add (Var "qy") (Neg (Var "oy"))) x1) x1) (Var "hy"))) (Mul (Sub (Add (Add
    (Var "qz") (Neg (Var "oz"))) x1) x1) (Var "hz")))).

(** quotient.Quotients.meet, parallel rays: T2 *)
Definition meet_parallel_T2 : expr :=
  let x1 := Neg (Var "ox") in
  let x2 := Add (Var "qx") x1 in
  let x3 := Mul (Var "unit") (Num 3 26) in
  let x4 := Sub (Add x2 x3) x3 in
  let x5 := Neg (Var "oy") in
  let x6 := Add (Var "qy") x5 in
  let x7 := Sub (Add x6 x3) x3 in
  let x8 := Neg (Var "oz") in
  let x9 := Add (Var "qz") x8 in
  let x10 := Sub (Add x9 x3) x3 in
  let x11 := Neg (Add (Add (Mul x4 (Var "hx")) (Mul x7 (Var "hy"))) (Mul x10 (Var "hz"))) in
  let x12 := Add (Var "T1") x11 in
  let x13 := Sub x12 (Var "T1") in
  let x14 := Sub x2 (Var "qx") in
  let x15 := Sub x6 (Var "qy") in
  let x16 := Sub x9 (Var "qz") in
  Add (Add (Sub (Var "T1") (Sub x12 x13)) (Sub x11 x13)) (Sub (Var "T2") (Add (Add (Add (Mul
    (Var "lx") x4) (Mul (Add (Var "hx") (Var "lx")) (Add (Sub x2 x4) (Add (Sub (Var "qx") (Sub x2
    x14)) (Sub x1 x14))))) (Add (Mul (Var "ly") x7) (Mul (Add (Var "hy") (Var "ly")) (Add (Sub x6
    x7) (Add (Sub (Var "qy") (Sub x6 x15)) (Sub x5 x15)))))) (Add (Mul (Var "lz") x10) (Mul (Add
    (Var "hz") (Var "lz")) (Add (Sub x9 x10) (Add (Sub (Var "qz") (Sub x9 x16)) (Sub x8 x16))))))).

(** quotient.Quotients.meet, parallel rays: ET *)
Definition meet_parallel_ET : expr :=
  Var "ET".

(** quotient.Quotients.meet, parallel rays: D1 *)
Definition meet_parallel_D1 : expr :=
  Var "D1".

(** quotient.Quotients.meet, parallel rays: D2 *)
Definition meet_parallel_D2 : expr :=
  Var "D2".

(** quotient.Quotients.meet, parallel rays: ED *)
Definition meet_parallel_ED : expr :=
  Var "ED".

(** quotient.Quotients._enter, rays that share nothing: hx *)
Definition table_alone_hx : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Sub (Add (Var "nx") x1) x1.

(** quotient.Quotients._enter, rays that share nothing: hy *)
Definition table_alone_hy : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Sub (Add (Var "ny") x1) x1.

(** quotient.Quotients._enter, rays that share nothing: hz *)
Definition table_alone_hz : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Sub (Add (Var "nz") x1) x1.

(** quotient.Quotients._enter, rays that share nothing: lx *)
Definition table_alone_lx : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Add (Sub (Var "nx") (Sub (Add (Var "nx") x1) x1)) (Var "n2x").

(** quotient.Quotients._enter, rays that share nothing: ly *)
Definition table_alone_ly : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Add (Sub (Var "ny") (Sub (Add (Var "ny") x1) x1)) (Var "n2y").

(** quotient.Quotients._enter, rays that share nothing: lz *)
Definition table_alone_lz : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz")))))
    (Num 1 1)) (Num 3 26) in
  Add (Sub (Var "nz") (Sub (Add (Var "nz") x1) x1)) (Var "n2z").

(** quotient.Quotients._enter, rays that share nothing: size *)
Definition table_alone_size : expr :=
  Add (Mul (Keep 1 (Abs (Max (Max (Abs (Var "nx")) (Abs (Var "ny"))) (Abs (Var "nz"))))) (Num 1 1))
    (Mul (Num 3 0) (Var "M")).

(** quotient.Quotients._enter, rays that share nothing: px *)
Definition table_alone_px : expr :=
  Var "px".

(** quotient.Quotients._enter, rays that share nothing: py *)
Definition table_alone_py : expr :=
  Var "py".

(** quotient.Quotients._enter, rays that share nothing: pz *)
Definition table_alone_pz : expr :=
  Var "pz".

(** quotient.Quotients.meet, rays that share nothing: T1 *)
Definition meet_alone_T1 : expr :=
  let x1 := Add (Var "px") (Neg (Var "ox")) in
  let x2 := Add (Var "py") (Neg (Var "oy")) in
  let x3 := Add (Var "pz") (Neg (Var "oz")) in
  let x4 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x1) (Abs x2)) (Abs x3)))) (Num 1 1)) (Num 3 26) in
  Add (Add (Mul (Sub (Add x1 x4) x4) (Var "hx")) (Mul (Sub (Add x2 x4) x4) (Var "hy"))) (Mul (Sub
    (Add x3 x4) x4) (Var "hz")).

(** quotient.Quotients.meet, rays that share nothing: T2 *)
Definition meet_alone_T2 : expr :=
  let x1 := Neg (Var "ox") in
  let x2 := Add (Var "px") x1 in
  let x3 := Neg (Var "oy") in
  let x4 := Add (Var "py") x3 in
  let x5 := Neg (Var "oz") in
  let x6 := Add (Var "pz") x5 in
  let x7 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs x2) (Abs x4)) (Abs x6)))) (Num 1 1)) (Num 3 26) in
  let x8 := Sub (Add x2 x7) x7 in
  let x9 := Sub x2 (Var "px") in
  let x10 := Sub (Add x4 x7) x7 in
  let x11 := Sub x4 (Var "py") in
  let x12 := Sub (Add x6 x7) x7 in
  let x13 := Sub x6 (Var "pz") in
  Add (Add (Add (Mul (Var "lx") x8) (Mul (Add (Var "hx") (Var "lx")) (Add (Sub x2 x8) (Add (Sub
    (Var "px") (Sub x2 x9)) (Sub x1 x9))))) (Add (Mul (Var "ly") x10) (Mul (Add (Var "hy")
    (Var "ly")) (Add (Sub x4 x10) (Add (Sub (Var "py") (Sub x4 x11)) (Sub x3 x11)))))) (Add (Mul
    (Var "lz") x12) (Mul (Add (Var "hz") (Var "lz")) (Add (Sub x6 x12) (Add (Sub (Var "pz") (Sub x6
    x13)) (Sub x5 x13))))).

(** quotient.Quotients.meet, rays that share nothing: ET *)
Definition meet_alone_ET : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Add (Var "px") (Neg (Var "ox")))) (Abs (Add
    (Var "py") (Neg (Var "oy"))))) (Abs (Add (Var "pz") (Neg (Var "oz"))))))) (Num 1 1))
    (Var "size") in
  Where (And (Less (Num 1 (-950)) x1) (Less x1 (Num 1 1000))) (Mul x1 (Num 1 (-72))) Inf.

(** quotient.Quotients.meet, rays that share nothing: D1 *)
Definition meet_alone_D1 : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "dx")) (Abs (Var "dy"))) (Abs (Var "dz")))))
    (Num 1 1)) (Num 3 26) in
  Add (Add (Mul (Sub (Add (Var "dx") x1) x1) (Var "hx")) (Mul (Sub (Add (Var "dy") x1) x1)
    (Var "hy"))) (Mul (Sub (Add (Var "dz") x1) x1) (Var "hz")).

(** quotient.Quotients.meet, rays that share nothing: D2 *)
Definition meet_alone_D2 : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "dx")) (Abs (Var "dy"))) (Abs (Var "dz")))))
    (Num 1 1)) (Num 3 26) in
  let x2 := Sub (Add (Var "dx") x1) x1 in
  let x3 := Sub (Add (Var "dy") x1) x1 in
  let x4 := Sub (Add (Var "dz") x1) x1 in
  Add (Add (Add (Mul (Var "lx") x2) (Mul (Add (Var "hx") (Var "lx")) (Add (Sub (Var "dx") x2)
    (Num 0 0)))) (Add (Mul (Var "ly") x3) (Mul (Add (Var "hy") (Var "ly")) (Add (Sub (Var "dy") x3)
    (Num 0 0))))) (Add (Mul (Var "lz") x4) (Mul (Add (Var "hz") (Var "lz")) (Add (Sub (Var "dz") x4)
    (Num 0 0)))).

(** quotient.Quotients.meet, rays that share nothing: ED *)
Definition meet_alone_ED : expr :=
  let x1 := Mul (Mul (Keep 1 (Abs (Max (Max (Abs (Var "dx")) (Abs (Var "dy"))) (Abs (Var "dz")))))
    (Num 1 1)) (Var "size") in
  Where (And (Less (Num 1 (-950)) x1) (Less x1 (Num 1 1000))) (Mul x1 (Num 1 (-72))) Inf.

(** quotient._quotient: t *)
Definition quotient_t : expr :=
  let x1 := Div (Num 1 0) (Add (Var "D1") (Var "D2")) in
  let x2 := Mul (Add (Var "T1") (Var "T2")) x1 in
  let x3 := Keep 26 x2 in
  let x4 := Keep 26 (Var "D1") in
  Add (Add (Mul (Add (Sub (Sub (Var "T1") (Mul x3 x4)) (Mul x3 (Sub (Var "D1") x4))) (Sub (Var "T2")
    (Mul x3 (Var "D2")))) x1) (Mul (Mul (Add (Mul (Abs x2) (Var "ED")) (Var "ET")) (Abs x1))
    (Num 4548635623644201 (-52)))) x3.

(** quotient._quotient: sure *)
Definition quotient_sure : test :=
  let x1 := Div (Num 1 0) (Add (Var "D1") (Var "D2")) in
  let x2 := Mul (Add (Var "T1") (Var "T2")) x1 in
  let x3 := Keep 26 x2 in
  let x4 := Keep 26 (Var "D1") in
  let x5 := Mul (Add (Sub (Sub (Var "T1") (Mul x3 x4)) (Mul x3 (Sub (Var "D1") x4))) (Sub (Var "T2")
    (Mul x3 (Var "D2")))) x1 in
  let x6 := Abs x2 in
  let x7 := Mul (Mul (Add (Mul x6 (Var "ED")) (Var "ET")) (Abs x1)) (Num 4548635623644201 (-52)) in
  And (Same (Add (Sub x5 x7) x3) (Add (Add x5 x7) x3)) (Less (Num 1 (-950)) x6).
