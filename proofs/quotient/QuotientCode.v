(** What [quotient.py] was seen to compute (RecordedQuotient.v) is what the theorems on t speak of.

    Each stage's expressions are worth the formulas of [ScalarProduct.v], [CrossProduct.v], [Ziv.v]
    and [Quotient.v], of the stage's variables: a vector named "n" has the components "nx", "ny",
    "nz". The stages are put together, and the theorems stated, in [QuotientWhole.v].

    An inf has no value here (it counts as 0): [no_inf] says that an expression chooses none.
    Where _quotient is given one, its test is False: [Overflow.infinite_error]. *)
Require Import ZArith Reals Psatz String Bool.
From Reftrace Require Import Trees Rounding Digits ScalarProduct CrossProduct Ziv Quotient Overflow.
From Reftrace Require RecordedQuotient.
From Flocq Require Import Core BinarySingleNaN.
Open Scope R_scope.
Open Scope string_scope.

Definition var (v : renv) (name : string) : R := r_var v name.
Definition vector (v : renv) (name : string) : vec :=
  Vec (r_var v (name ++ "x")) (r_var v (name ++ "y")) (r_var v (name ++ "z")).
Definition fl3 (v : renv) (x y z : expr) : vec := Vec (fl v x) (fl v y) (fl v z).

Lemma split_pair {A B} (a : A) (b : B) p : (a, b) = p -> a = fst p /\ b = snd p.
Proof. now intros <-. Qed.

(** ** Powers of two: bits are masked away, of the largest component *)

Definition above (x y z : expr) : expr :=
  Mul (Keep 1 (Abs (Max (Max (Abs x) (Abs y)) (Abs z)))) (Num 1 1).

Lemma above_raw x y z :
  rnd (round radix2 (FLT_exp (-1074 + prec - 1) 1) Ztrunc (Rabs (Rmax (Rmax (Rabs x) (Rabs y)) (Rabs z)))
    * (1 * pow2 1)) = power_above (Vec x y z).
Proof.
  rewrite (Rabs_pos_eq (Rmax _ _)) by (eapply Rle_trans; [apply Rabs_pos | apply Rmax_r]).
  replace (1 * pow2 1) with 2 by (simpl (pow2 1); lra). reflexivity.
Qed.
Lemma above_code v x y z : fl v (above x y z) = power_above (fl3 v x y z).
Proof. apply above_raw. Qed.

Theorem power_above_code v : fl v RecordedQuotient.power_above = power_above (vector v "v").
Proof. apply above_raw. Qed.
Theorem unit_from_point_code v : fl v RecordedQuotient.unit_from_point = power_above (vector v "d").
Proof.
  change (fl v RecordedQuotient.unit_from_point)
    with (fl v (above (Abs (Var "dx")) (Abs (Var "dy")) (Abs (Var "dz")))).
  rewrite above_code. unfold power_above, largest, fl3. cbn [value px py pz]. now rewrite !Rabs_Rabsolu.
Qed.

(** A difference, as two_sum takes it. *)
Definition away (x y : string) : expr := Add (Var x) (Neg (Var y)).

Lemma num_0 : 0 * pow2 0 = 0. Proof. apply Rmult_0_l. Qed.
Lemma num_1 : 1 * pow2 0 = 1. Proof. apply Rmult_1_r. Qed.
Lemma num_3 : 3 * pow2 0 = 3. Proof. apply Rmult_1_r. Qed.

(** Both sides are unfolded as far as roundings, and are the same then. *)
Ltac code :=
  intros;
  cbv beta iota zeta delta [value vector var fl3 String.append prepared_dot dot two_sum halves minor cross
    cross2 high_half low_half map2 sums rests zero px py pz fst snd size_of];
  rewrite ?above_raw, ?num_0, ?num_1, ?num_3; try reflexivity.

(** ** The small functions *)

Theorem two_sum_code v :
  (fl v RecordedQuotient.two_sum_high, fl v RecordedQuotient.two_sum_low) = two_sum (var v "a") (var v "b").
Proof. reflexivity. Qed.
Theorem halves_code v :
  (fl v RecordedQuotient.halves_high, fl v RecordedQuotient.halves_low) = halves (var v "v") (var v "unit").
Proof. reflexivity. Qed.
Theorem highest_code v : fl v RecordedQuotient.highest = highest (var v "a").
Proof. reflexivity. Qed.

Theorem product_code v : (fl v RecordedQuotient.product_high, fl v RecordedQuotient.product_low) =
  dot (vector v "v") (vector v "v2") (var v "unit") (vector v "h") (vector v "l").
Proof. unfold RecordedQuotient.product_high, RecordedQuotient.product_low. code. Qed.
Theorem product_of_one_code v : (fl v RecordedQuotient.product_of_one_high, fl v RecordedQuotient.product_of_one_low) =
  dot (vector v "v") zero (var v "unit") (vector v "h") (vector v "l").
Proof. unfold RecordedQuotient.product_of_one_high, RecordedQuotient.product_of_one_low. code. Qed.

Theorem cross_code v :
  (fl3 v RecordedQuotient.cross_x RecordedQuotient.cross_y RecordedQuotient.cross_z,
   fl3 v RecordedQuotient.cross_low_x RecordedQuotient.cross_low_y RecordedQuotient.cross_low_z, fl v RecordedQuotient.cross_M) =
  cross2 (vector v "u") (vector v "u2") (vector v "v") (vector v "v2").
Proof.
  unfold RecordedQuotient.cross_x, RecordedQuotient.cross_y, RecordedQuotient.cross_z, RecordedQuotient.cross_low_x, RecordedQuotient.cross_low_y,
    RecordedQuotient.cross_low_z, RecordedQuotient.cross_M. code.
Qed.

(** ** The quotient and its test *)

Theorem quotient_code v : (fl v RecordedQuotient.quotient_t, truth rnd v RecordedQuotient.quotient_sure) =
  quotient (var v "T1") (var v "T2") (var v "ET") (var v "D1") (var v "D2") (var v "ED").
Proof.
  unfold RecordedQuotient.quotient_t, RecordedQuotient.quotient_sure, quotient.
  cbv beta iota zeta delta [value truth var]. rewrite num_1, Rmult_1_l. reflexivity.
Qed.

(** ** Errors: finite only in range *)

(** It computes no inf; what Where does not choose, and what its condition is of, does not count. *)
Fixpoint no_inf (v : renv) (e : expr) : bool :=
  match e with
  | Var _ | Num _ _ => true
  | Inf => false
  | Add a b | Sub a b | Mul a b | Div a b | Max a b | Min a b | CopySign a b => no_inf v a && no_inf v b
  | Abs a | Neg a | Next a | Prev a | Floor a | Ceil a | Keep _ a => no_inf v a
  | Where c a b => if truth rnd v c then no_inf v a else no_inf v b
  end.

Definition error_tree (unit size : expr) : expr :=
  let x := Mul unit size in
  Where (And (Less (Num 1 (-950)) x) (Less x (Num 1 1000))) (Mul x (Num 1 (-72))) Inf.

Lemma error_code v unit size : no_inf v (error_tree unit size) = true ->
  in_range (fl v unit) (fl v size) /\ fl v (error_tree unit size) = error_of (fl v unit) (fl v size).
Proof.
  unfold error_tree, in_range, error_of. cbn [no_inf value truth]. rewrite !Rmult_1_l.
  case Rlt_bool_spec; intros L1; [|discriminate]. case Rlt_bool_spec; intros L2; [|discriminate].
  auto.
Qed.
Lemma error_code_inf v unit size : no_inf v unit = true -> no_inf v size = true ->
  in_range (fl v unit) (fl v size) -> no_inf v (error_tree unit size) = true.
Proof.
  unfold error_tree, in_range. cbn [no_inf value truth]. rewrite !Rmult_1_l. intros -> -> [A B].
  now rewrite !Rlt_bool_true by assumption.
Qed.

Theorem product_error_code v : no_inf v RecordedQuotient.product_error = true <->
  in_range (var v "unit") (var v "size").
Proof.
  change RecordedQuotient.product_error with (error_tree (Var "unit") (Var "size")). split.
  - exact (fun H => proj1 (error_code v (Var "unit") (Var "size") H)).
  - now apply (error_code_inf v (Var "unit") (Var "size")).
Qed.
Theorem product_error_value v : no_inf v RecordedQuotient.product_error = true ->
  fl v RecordedQuotient.product_error = error_of (var v "unit") (var v "size").
Proof. exact (fun H => proj2 (error_code v (Var "unit") (Var "size") H)). Qed.
(** Otherwise it is inf. *)
Theorem product_error_inf v : no_inf v RecordedQuotient.product_error = false ->
  exists c e, RecordedQuotient.product_error = Where c e Inf /\ truth rnd v c = false.
Proof.
  intros H. do 2 eexists. split; [reflexivity|]. revert H. unfold RecordedQuotient.product_error.
  cbn [no_inf]. destruct (truth rnd v _); [discriminate | reflexivity].
Qed.

(** ** The normal of a triangle *)

Definition recorded_normal v := fl3 v RecordedQuotient.normal_x RecordedQuotient.normal_y RecordedQuotient.normal_z.
Definition recorded_normal_low v := fl3 v RecordedQuotient.normal_low_x RecordedQuotient.normal_low_y RecordedQuotient.normal_low_z.

Theorem normal_code v : no_inf v RecordedQuotient.normal_M = true ->
  (recorded_normal v, recorded_normal_low v, fl v RecordedQuotient.normal_M) =
    cross2 (sums (vector v "b") (vector v "a")) (rests (vector v "b") (vector v "a"))
      (sums (vector v "c") (vector v "a")) (rests (vector v "c") (vector v "a")) /\
  pow2 (-950) < fl v RecordedQuotient.normal_M.
Proof.
  set (M := Mul (above (away "bx" "ax") (away "by" "ay") (away "bz" "az"))
    (above (away "cx" "ax") (away "cy" "ay") (away "cz" "az"))).
  change RecordedQuotient.normal_M with (Where (Less (Num 1 (-950)) M) M Inf).
  cbn [no_inf value truth]. rewrite Rmult_1_l.
  case Rlt_bool_spec; intros L; [|discriminate]. intros _. split; [|exact L].
  unfold M, away, above, recorded_normal, recorded_normal_low,
    RecordedQuotient.normal_x, RecordedQuotient.normal_y, RecordedQuotient.normal_z,
    RecordedQuotient.normal_low_x, RecordedQuotient.normal_low_y, RecordedQuotient.normal_low_z. code.
Qed.

(** ** The tables: the normal in halves, T of the rays' common origin, and errors *)

Section Table.
Variable v : renv.
Let n := vector v "n".
Let m := vector v "n2".
Let p := vector v "p".
Let o := vector v "o".
Let arm := sums p o.
Let size := size_of n (var v "M").

Definition high_of := high_half (power_above n) n.
Definition low_of := low_half (power_above n) n m.

Theorem table_from_point_halves :
  fl3 v RecordedQuotient.table_from_point_hx RecordedQuotient.table_from_point_hy RecordedQuotient.table_from_point_hz = high_of /\
  fl3 v RecordedQuotient.table_from_point_lx RecordedQuotient.table_from_point_ly RecordedQuotient.table_from_point_lz = low_of.
Proof.
  unfold high_of, low_of, n, m,
    RecordedQuotient.table_from_point_hx, RecordedQuotient.table_from_point_hy, RecordedQuotient.table_from_point_hz,
    RecordedQuotient.table_from_point_lx, RecordedQuotient.table_from_point_ly, RecordedQuotient.table_from_point_lz. code. now split.
Qed.
Theorem table_parallel_halves :
  fl3 v RecordedQuotient.table_parallel_hx RecordedQuotient.table_parallel_hy RecordedQuotient.table_parallel_hz = high_of /\
  fl3 v RecordedQuotient.table_parallel_lx RecordedQuotient.table_parallel_ly RecordedQuotient.table_parallel_lz = low_of.
Proof. exact table_from_point_halves. Qed.
Theorem table_alone_halves :
  fl3 v RecordedQuotient.table_alone_hx RecordedQuotient.table_alone_hy RecordedQuotient.table_alone_hz = high_of /\
  fl3 v RecordedQuotient.table_alone_lx RecordedQuotient.table_alone_ly RecordedQuotient.table_alone_lz = low_of.
Proof. exact table_from_point_halves. Qed.

Definition table_T := let over := prepared_dot arm (rests p o) (power_above arm) n m in
  two_sum (fst over) (snd over).
Theorem table_from_point_T :
  (fl v RecordedQuotient.table_from_point_T1, fl v RecordedQuotient.table_from_point_T2) = table_T.
Proof.
  unfold table_T, arm, n, m, p, o, RecordedQuotient.table_from_point_T1, RecordedQuotient.table_from_point_T2. code.
Qed.
Theorem table_parallel_T :
  (fl v RecordedQuotient.table_parallel_T1, fl v RecordedQuotient.table_parallel_T2) = table_T.
Proof. exact table_from_point_T. Qed.
Theorem table_parallel_D :
  (fl v RecordedQuotient.table_parallel_D1, fl v RecordedQuotient.table_parallel_D2) =
  prepared_dot (vector v "d") zero (power_above (vector v "d")) n m.
Proof. unfold n, m, RecordedQuotient.table_parallel_D1, RecordedQuotient.table_parallel_D2. code. Qed.

(** N + 3 M *)
Definition size_tree : expr := Add (above (Var "nx") (Var "ny") (Var "nz")) (Mul (Num 3 0) (Var "M")).
Lemma size_code : fl v size_tree = size.
Proof. unfold size_tree, above, size, n. code. Qed.
Theorem table_alone_size : fl v RecordedQuotient.table_alone_size = size.
Proof. exact size_code. Qed.
Theorem table_alone_p :
  fl3 v RecordedQuotient.table_alone_px RecordedQuotient.table_alone_py RecordedQuotient.table_alone_pz = p.
Proof. reflexivity. Qed.

Definition reach_tree : expr :=
  above (away "px" "ox") (away "py" "oy") (away "pz" "oz").
Lemma reach_code : fl v reach_tree = power_above arm.
Proof. unfold reach_tree. rewrite above_code. reflexivity. Qed.
Definition along_tree : expr := above (Var "dx") (Var "dy") (Var "dz").
Lemma along_code : fl v along_tree = power_above (vector v "d").
Proof. unfold along_tree. rewrite above_code. reflexivity. Qed.

Theorem table_from_point_ET : no_inf v RecordedQuotient.table_from_point_ET = true ->
  in_range (power_above arm) size /\ fl v RecordedQuotient.table_from_point_ET = error_of (power_above arm) size.
Proof. rewrite <- reach_code, <- size_code. exact (error_code v reach_tree size_tree). Qed.
Theorem table_from_point_ED : no_inf v RecordedQuotient.table_from_point_ED = true ->
  in_range (var v "unit") size /\ fl v RecordedQuotient.table_from_point_ED = error_of (var v "unit") size.
Proof. rewrite <- size_code. exact (error_code v (Var "unit") size_tree). Qed.
Theorem table_parallel_ET : no_inf v RecordedQuotient.table_parallel_ET = true ->
  (in_range (power_above arm) size /\ in_range (var v "unit") size) /\
  fl v RecordedQuotient.table_parallel_ET = rnd (error_of (power_above arm) size + error_of (var v "unit") size).
Proof.
  change RecordedQuotient.table_parallel_ET
    with (Add (error_tree reach_tree size_tree) (error_tree (Var "unit") size_tree)).
  intros H. apply andb_prop in H. destruct H as [H1 H2]. apply error_code in H1, H2.
  rewrite reach_code, size_code in H1. rewrite size_code in H2. cbn [value] in H2 |- *.
  destruct H1 as [A ->], H2 as [B ->]. now split.
Qed.
Theorem table_parallel_ED : no_inf v RecordedQuotient.table_parallel_ED = true ->
  in_range (power_above (vector v "d")) size /\
  fl v RecordedQuotient.table_parallel_ED = error_of (power_above (vector v "d")) size.
Proof. rewrite <- along_code, <- size_code. exact (error_code v along_tree size_tree). Qed.
End Table.

(** ** What [meet] makes of a column of the table and a ray *)

Section Meet.
Variable v : renv.
Let dot_of w rest unit := dot w rest unit (vector v "h") (vector v "l").
Let d := vector v "d".
Let arm := sums (vector v "p") (vector v "o").

Theorem meet_from_point_T : fl v RecordedQuotient.meet_from_point_T1 = var v "T1" /\
  fl v RecordedQuotient.meet_from_point_T2 = var v "T2" /\ fl v RecordedQuotient.meet_from_point_ET = var v "ET" /\
  fl v RecordedQuotient.meet_from_point_ED = var v "ED".
Proof. repeat split. Qed.
Theorem meet_from_point_D :
  (fl v RecordedQuotient.meet_from_point_D1, fl v RecordedQuotient.meet_from_point_D2) = dot_of d zero (var v "unit").
Proof. unfold dot_of, d, RecordedQuotient.meet_from_point_D1, RecordedQuotient.meet_from_point_D2. code. Qed.

Theorem meet_parallel_T :
  let q := vector v "q" in let o := vector v "o" in
  let part := dot_of (sums q o) (rests q o) (var v "unit") in
  let t := two_sum (var v "T1") (- fst part) in
  (fl v RecordedQuotient.meet_parallel_T1, fl v RecordedQuotient.meet_parallel_T2) =
  (fst t, rnd (snd t + rnd (var v "T2" - snd part))).
Proof. unfold dot_of, RecordedQuotient.meet_parallel_T1, RecordedQuotient.meet_parallel_T2. code. Qed.
Theorem meet_parallel_rest : fl v RecordedQuotient.meet_parallel_ET = var v "ET" /\
  fl v RecordedQuotient.meet_parallel_D1 = var v "D1" /\ fl v RecordedQuotient.meet_parallel_D2 = var v "D2" /\
  fl v RecordedQuotient.meet_parallel_ED = var v "ED".
Proof. repeat split. Qed.

Theorem meet_alone_T : (fl v RecordedQuotient.meet_alone_T1, fl v RecordedQuotient.meet_alone_T2) =
  dot_of arm (rests (vector v "p") (vector v "o")) (power_above arm).
Proof. unfold dot_of, arm, RecordedQuotient.meet_alone_T1, RecordedQuotient.meet_alone_T2. code. Qed.
Theorem meet_alone_D : (fl v RecordedQuotient.meet_alone_D1, fl v RecordedQuotient.meet_alone_D2) =
  dot_of d zero (power_above d).
Proof. unfold dot_of, d, RecordedQuotient.meet_alone_D1, RecordedQuotient.meet_alone_D2. code. Qed.
Theorem meet_alone_ET : no_inf v RecordedQuotient.meet_alone_ET = true ->
  in_range (power_above arm) (var v "size") /\
  fl v RecordedQuotient.meet_alone_ET = error_of (power_above arm) (var v "size").
Proof. unfold arm. rewrite <- reach_code. exact (error_code v reach_tree (Var "size")). Qed.
Theorem meet_alone_ED : no_inf v RecordedQuotient.meet_alone_ED = true ->
  in_range (power_above d) (var v "size") /\
  fl v RecordedQuotient.meet_alone_ED = error_of (power_above d) (var v "size").
Proof. unfold d. rewrite <- along_code. exact (error_code v along_tree (Var "size")). Qed.
End Meet.
