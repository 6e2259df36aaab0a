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

(** contest.in_range: the path *)
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

(** contest.in_range: the path *)
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
