(** Which of two surfaces is nearer, for many rays at once: order.py.

    T1 D2 - T2 D1 is f0 + x . v for every ray, x being its direction, or how far its origin is from
    the first one. f0 and v are integers, rounded once each to the table that all rays share. The
    bound of Signs.v leaves room for that rounding, too. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees Rounding Magnitude Finite Signs Forms Pairs RecordedDecisions.
Open Scope R_scope.
Open Scope string_scope.

Definition table : tvec := (Var "v1", Var "v2", Var "v3").
Definition apart : tvec :=
  (Sub (Var "ox") (Var "o0x"), Sub (Var "oy") (Var "o0y"), Sub (Var "oz") (Var "o0z")).
Definition order_value x := Add (Var "base") (tdot x table).
Definition order_error x := tbound (Add (Abs (Var "base")) (tdot (tabs x) (tabs table))) (tabs x).

Lemma recorded_order :
  order_from_point_value = order_value d /\ order_from_point_error = order_error d /\
  order_parallel_value = order_value apart /\ order_parallel_error = order_error apart /\
  order_from_point_known = Less order_from_point_error (Abs order_from_point_value) /\
  order_parallel_known = Less order_parallel_error (Abs order_parallel_value).
Proof. repeat split; reflexivity. Qed.

(** What is known of a ray: x . v + f0 is not 0, and has the sign of what was computed. *)
Section Order.
Variable v : env.
Variables f0 w1 w2 w3 : R. (* exact, scaled by one power of two *)
Notation table_of name := (B2R (of_var v name)).
Hypothesis rounded_base : table_of "base" = rnd f0. (* Python's division of integers rounds once *)
Hypothesis rounded_v1 : table_of "v1" = rnd w1.
Hypothesis rounded_v2 : table_of "v2" = rnd w2.
Hypothesis rounded_v3 : table_of "v3" = rnd w3.

Variable x : tvec.
Hypothesis x_is : x = d \/ x = apart.
Notation xx := (ex (real_env v) (X x)).
Notation xy := (ex (real_env v) (Y x)).
Notation xz := (ex (real_env v) (Z' x)).

Lemma order_bound :
  Rabs (fl (real_env v) (order_value x) - ex (real_env v) (order_value x)) <=
    3 / 4 * fl (real_env v) (order_error x) /\
  11 * u * mag (real_env v) (order_value x) + slack / 2 * (1 + (Rabs xx + Rabs xy + Rabs xz)) <=
    fl (real_env v) (order_error x).
Proof.
  destruct x_is as [->| ->].
  - apply bound_holds_and; try apply real_env_floats; auto; shape. of_plane.
  - apply bound_holds_and; try apply real_env_floats; auto; shape. of_plane.
Qed.

Lemma order_numbers : is_finite (eval v (order_error x)) = true ->
  B2R (eval v (order_error x)) = fl (real_env v) (order_error x) /\
  is_finite (eval v (order_value x)) = true /\
  B2R (eval v (order_value x)) = fl (real_env v) (order_value x).
Proof.
  intros F.
  assert (VE : B2R (eval v (order_error x)) = fl (real_env v) (order_error x)).
  { apply finite_value; [easy | | exact F]. now destruct x_is as [->| ->]. }
  split; [exact VE|].
  assert (A : above (eval v (Add (Abs (Var "base")) (tdot (tabs x) (tabs table)))) (eval v (order_value x))).
  { destruct x_is as [->| ->]; unfold order_value, apart, table; names; by_above. }
  unfold order_error, tbound in F. cbn [eval] in F.
  destruct (plus_finite _ _ F) as [F1 _]. destruct (mult_finite _ _ F1) as [_ F2].
  destruct (proj2 A F2) as [Fv _]. split; [exact Fv|].
  apply finite_value; [easy | | exact Fv]. now destruct x_is as [->| ->].
Qed.

(** The leaves were rounded, too. *)
Lemma of_leaf y : Rabs (rnd y - y) <= 101 / 100 * u * Rabs (rnd y) + 2 * eta.
Proof.
  assert (H := rnd_err y). assert (U := u_pos). assert (Us := u_small). assert (N := eta_pos).
  assert (T := Rabs_triang_inv y (y - rnd y)). replace (y - (y - rnd y)) with (rnd y) in T by ring.
  rewrite (Rabs_minus_sym y (rnd y)) in T. set (a := Rabs y) in *. set (b := Rabs (rnd y)) in *.
  assert (Pa : 0 <= a) by apply Rabs_pos. assert (Pb : 0 <= b) by apply Rabs_pos.
  assert (K : u * a <= u * (b + (u * a + eta))) by (apply Rmult_le_compat_l; lra).
  assert (0 <= u * a <= / 1000000 * a) by (split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
  assert (u * (u * a) <= / 1000000 * (u * a)) by (apply Rmult_le_compat_r; lra).
  assert (u * eta <= / 1000000 * eta) by (apply Rmult_le_compat_r; lra).
  assert (0 <= u * b) by (apply Rmult_le_pos; lra). lra.
Qed.

Theorem order_sign : holds v (Less (order_error x) (Abs (order_value x))) = true ->
  let f := f0 + (xx * w1 + xy * w2 + xz * w3) in
  (0 < B2R (eval v (order_value x)) /\ 0 < f) \/ (B2R (eval v (order_value x)) < 0 /\ f < 0).
Proof.
  intros H f.
  assert (P : not_negative (eval v (order_error x))).
  { unfold order_error. apply not_negative_bound; destruct x_is as [->| ->]; unfold apart, table; names; cbn [eval];
      repeat first [apply not_negative_plus | apply not_negative_mult | apply not_negative_abs]. }
  cbn [holds eval] in H. destruct (Bcompare _ _) as [[]|] eqn:C in H; try discriminate.
  assert (F : is_finite (eval v (order_error x)) = true) by (eapply decided_finite; eauto).
  destruct (order_numbers F) as [VE [Fv Vv]].
  apply less_finite in C; auto; [|now rewrite is_finite_Babs]. rewrite B2R_Babs, VE, Vv in C. rewrite Vv.
  destruct order_bound as [B L]. assert (U := u_pos). assert (N := eta_pos). assert (NS := eta_slack).
  assert (S := slack_pos).
  set (E := fl (real_env v) (order_error x)) in *. set (g := fl (real_env v) (order_value x)) in *.
  assert (M : mag (real_env v) (order_value x) =
    Rabs (table_of "base") + (Rabs xx * Rabs (table_of "v1") + Rabs xy * Rabs (table_of "v2") + Rabs xz * Rabs (table_of "v3"))).
  { destruct x_is as [->| ->]; reflexivity. }
  assert (G : ex (real_env v) (order_value x) =
    table_of "base" + (xx * table_of "v1" + xy * table_of "v2" + xz * table_of "v3")).
  { destruct x_is as [->| ->]; reflexivity. }
  rewrite rounded_base, rounded_v1, rounded_v2, rounded_v3 in M, G.
  assert (D : Rabs (ex (real_env v) (order_value x) - f) <=
    101 / 100 * u * mag (real_env v) (order_value x) + 2 * eta * (1 + (Rabs xx + Rabs xy + Rabs xz))).
  { rewrite G, M. unfold f.
    replace (rnd f0 + (xx * rnd w1 + xy * rnd w2 + xz * rnd w3) - (f0 + (xx * w1 + xy * w2 + xz * w3)))
      with ((rnd f0 - f0) + (xx * (rnd w1 - w1) + (xy * (rnd w2 - w2) + xz * (rnd w3 - w3)))) by ring.
    eapply Rle_trans; [apply Rabs_triang|].
    assert (T1 := Rabs_triang (xx * (rnd w1 - w1)) (xy * (rnd w2 - w2) + xz * (rnd w3 - w3))).
    assert (T2 := Rabs_triang (xy * (rnd w2 - w2)) (xz * (rnd w3 - w3))).
    rewrite (Rabs_mult xx) in T1. rewrite (Rabs_mult xy), (Rabs_mult xz) in T2.
    assert (K : forall y w, Rabs y * Rabs (rnd w - w) <= 101 / 100 * u * (Rabs y * Rabs (rnd w)) + 2 * eta * Rabs y).
    { intros y w. replace (101 / 100 * u * (Rabs y * Rabs (rnd w)) + 2 * eta * Rabs y)
        with (Rabs y * (101 / 100 * u * Rabs (rnd w) + 2 * eta)) by ring.
      apply Rmult_le_compat_l; [apply Rabs_pos | apply of_leaf]. }
    generalize (of_leaf f0) (K xx w1) (K xy w2) (K xz w3). lra. }
  rewrite M in L, D. set (m := Rabs (rnd f0) + (Rabs xx * Rabs (rnd w1) + Rabs xy * Rabs (rnd w2) + Rabs xz * Rabs (rnd w3))) in *.
  assert (Pm : 0 <= m).
  { unfold m. assert (K : forall y z, 0 <= Rabs y * Rabs z) by (intros; apply Rmult_le_pos; apply Rabs_pos).
    generalize (Rabs_pos (rnd f0)) (K xx (rnd w1)) (K xy (rnd w2)) (K xz (rnd w3)). lra. }
  set (W := Rabs xx + Rabs xy + Rabs xz) in *.
  assert (PW : 0 <= W) by (unfold W; generalize (Rabs_pos xx) (Rabs_pos xy) (Rabs_pos xz); lra).
  assert (0 <= u * m) by (apply Rmult_le_pos; lra). assert (0 <= slack * W) by (apply Rmult_le_pos; lra).
  rewrite NS in D.
  assert (Total : Rabs (g - f) < Rabs g).
  { replace (g - f) with ((g - ex (real_env v) (order_value x)) + (ex (real_env v) (order_value x) - f)) by ring.
    eapply Rle_lt_trans; [apply Rabs_triang|]. lra. }
  revert Total. unfold Rabs. destruct (Rcase_abs (g - f)), (Rcase_abs g); lra.
Qed.
End Order.

(** ** What the sign says: T1 D2 - T2 D1, for both kinds of rays *)

Lemma order_from_point_is (T1 T2 : R) (n1 n2 d : vec) :
  T1 * dot d n2 - T2 * dot d n1 = dot d (vsub (vscale T1 n2) (vscale T2 n1)).
Proof. unfold dot, vsub, vscale; simpl; ring. Qed.

(** T of parallel rays: T0 - (o - o0) . n, T0 for the origin o0. *)
Lemma order_parallel_is (p1 p2 n1 n2 o o0 d : vec) :
  let T p n o := dot (vsub p o) n in
  let D n := dot d n in
  T p1 n1 o * D n2 - T p2 n2 o * D n1 =
  (T p1 n1 o0 * D n2 - T p2 n2 o0 * D n1) +
  dot (vsub o o0) (vsub (vscale (D n1) n2) (vscale (D n2) n1)).
Proof. unfold dot, vsub, vscale; simpl; ring. Qed.

(** The sign of T1 D2 - T2 D1, times that of D1 D2, is the sign of t1 - t2. *)
Lemma order_of_t (T1 D1 T2 D2 : R) : D1 <> 0 -> D2 <> 0 ->
  (T1 / D1 < T2 / D2 <-> (T1 * D2 - T2 * D1) * (D1 * D2) < 0).
Proof.
  intros N1 N2.
  assert (P : 0 < (D1 * D2) * (D1 * D2)).
  { assert (D1 * D2 <> 0) by now apply Rmult_integral_contrapositive_currified. nra. }
  assert (E : (T1 * D2 - T2 * D1) * (D1 * D2) = (T1 / D1 - T2 / D2) * ((D1 * D2) * (D1 * D2))) by (field; auto).
  rewrite E. split; intros H; nra.
Qed.
