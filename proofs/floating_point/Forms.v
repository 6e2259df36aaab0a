(** The bound, for every form in which [bounds.py] computes e, T and D.

    A vector named "a" has the components "ax", "ay", "az". The corners are a, b, c; o is the ray's
    origin, d its direction. The bound is that of all rays: of the largest |d| of them ("r"), or of
    origins within a box from "l" to "h". That this ray is one of those is the premise. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees Rounding Magnitude Signs.
Open Scope R_scope.
Open Scope string_scope.

Definition tvar (name : string) : tvec :=
  (Var (name ++ "x"), Var (name ++ "y"), Var (name ++ "z")).
Definition real_vec (v : env) (name : string) : vec :=
  V (B2R (of_var v (name ++ "x"))) (B2R (of_var v (name ++ "y"))) (B2R (of_var v (name ++ "z"))).
Definition real_ray v := Ray (real_vec v "o") (real_vec v "d").

Definition a := tvar "a". Definition b := tvar "b". Definition c := tvar "c".
Definition o := tvar "o". Definition d := tvar "d".
Definition ab := tsub b a. Definition ac := tsub c a.
Definition arm p := tsub p o.

(** From a point: e = d . ((p - o) x (q - p)), T = (a - o) . n, D = d . n. *)
Definition edge_from_point p q := tdot (tcross (arm p) (tsub q p)) d.
Definition size_of_edge p q := tsize (tabs (arm p)) (tabs (tsub q p)).
Definition of_n := tcross ab ac.
Definition size_of_n := tsize (tabs ab) (tabs ac).
Definition T_of := tdot (arm a) of_n.
Definition D_of := tdot d of_n.
(** Parallel rays: e = (p - o) . ((q - p) x d). *)
Definition edge_parallel p q := tdot (arm p) (tcross (tsub q p) d).
(** An infinite plane: T = (p - o) . n, D = d . n. *)
Definition T_plane := tdot (arm (tvar "p")) (tvar "n").
Definition D_plane := tdot d (tvar "n").

(** Their bounds for this one ray. *)
Definition one_edge p q := tbound (tdot (tabs d) (size_of_edge p q)) (tabs d).
Definition one_T := tbound (tdot (tabs (arm a)) size_of_n) (tabs (arm a)).
Definition one_D := tbound (tdot (tabs d) size_of_n) (tabs d).
Definition one_parallel p q :=
  tbound (tdot (tabs (arm p)) (tsize (tabs (tsub q p)) (tabs d))) (tabs (arm p)).
Definition one_T_plane :=
  tbound (tdot (tabs (arm (tvar "p"))) (tabs (tvar "n"))) (tabs (arm (tvar "p"))).
Definition one_D_plane := tbound (tdot (tabs d) (tabs (tvar "n"))) (tabs d).

Ltac shape :=
  cbv -[value mag room eta Rplus Rmult Rminus Rle Rabs IZR is_float bpow radix2 ex];
  cbn [value mag room leaf andb]; repeat split;
  auto using Rabs_pos, float_12u, float_slack, float_one; try lia; rewrite ?Rabs_Rabsolu;
  try apply Rabs_pos; try ring.

Ltac of_plane :=
  match goal with |- _ <= _ + eta * (2 * (Rabs ?x + Rabs ?y + Rabs ?z) + 3) =>
    assert (0 <= eta * (Rabs x + Rabs y + Rabs z))
      by (apply Rmult_le_pos; [apply Rlt_le, eta_pos | generalize (Rabs_pos x) (Rabs_pos y) (Rabs_pos z); lra])
  end; lra.

Section OneRay.
Variable v : renv.
Hypothesis floats : forall name, is_float (r_var v name).
Notation off e p := (Rabs (fl v e - ex v e) <= 3 / 4 * fl v p).

Ltac by_bound := apply bound_holds; auto; shape; generalize eta_pos; nra.

Lemma edge_ab_off : off (edge_from_point a b) (one_edge a b). Proof. by_bound. Qed.
Lemma edge_bc_off : off (edge_from_point b c) (one_edge b c). Proof. by_bound. Qed.
Lemma edge_ca_off : off (edge_from_point c a) (one_edge c a). Proof. by_bound. Qed.
Lemma T_off : off T_of one_T. Proof. by_bound. Qed.
Lemma D_off : off D_of one_D. Proof. by_bound. Qed.
Lemma parallel_ab_off : off (edge_parallel a b) (one_parallel a b). Proof. by_bound. Qed.
Lemma parallel_bc_off : off (edge_parallel b c) (one_parallel b c). Proof. by_bound. Qed.
Lemma parallel_ca_off : off (edge_parallel c a) (one_parallel c a). Proof. by_bound. Qed.
Lemma T_plane_off : off T_plane one_T_plane.
Proof. apply bound_holds; auto; shape. of_plane. Qed.
Lemma D_plane_off : off D_plane one_D_plane.
Proof. apply bound_holds; auto; shape. of_plane. Qed.
End OneRay.

(** ** The bounds that the code computes, for all rays at once *)

Definition r := tvar "r". Definition l := tvar "l". Definition h := tvar "h".
Definition largest3 x y z := Max (Max x y) z.
Definition tlargest3 x y z := tmax (tmax x y) z.

Definition E_from_point :=
  tbound (tdot r (tlargest3 (size_of_edge a b) (size_of_edge b c) (size_of_edge c a))) r.
Definition E_D_from_point := tbound (tdot r size_of_n) r.
Definition far p := tmax (tabs (tsub p l)) (tabs (tsub p h)).
Definition E_parallel_edge p q := tbound (tdot (far p) (tsize (tabs (tsub q p)) (tabs d))) (far p).
Definition E_parallel := largest3 (E_parallel_edge a b) (E_parallel_edge b c) (E_parallel_edge c a).
Definition E_T_parallel := tbound (tdot (far a) size_of_n) (far a).

(** This ray is one of those that the bound is for: |d| <= r; l <= o <= h. *)
Definition within_reach v :=
  dominates v (X r) (X d) /\ dominates v (Y r) (Y d) /\ dominates v (Z' r) (Z' d).

Definition between v low x high :=
  is_finite (eval v low) = true /\ is_finite (eval v x) = true /\ is_finite (eval v high) = true /\
  B2R (eval v low) <= B2R (eval v x) <= B2R (eval v high).
Definition within_box v :=
  between v (X l) (X o) (X h) /\ between v (Y l) (Y o) (Y h) /\ between v (Z' l) (Z' o) (Z' h).

Lemma above_box v p low x high : between v low x high ->
  above (eval v (Max (Abs (Sub p low)) (Abs (Sub p high)))) (eval v (Sub p x)).
Proof.
  intros [Fl [Fx [Fh [L H]]]]. cbn [eval].
  set (P := eval v p) in *. set (lo := eval v low) in *. set (hi := eval v high) in *. set (xx := eval v x) in *.
  split; [apply not_negative_max; apply not_negative_abs|]. unfold fmax. intros F.
  destruct (is_finite (Bminus mode_NE P lo)) eqn:F1, (is_finite (Bminus mode_NE P hi)) eqn:F2.
  - destruct (minus_finite _ _ F1) as [Fp _].
    assert (L2 : Rabs (rnd (B2R P - B2R xx)) <= Rmax (Rabs (rnd (B2R P - B2R lo))) (Rabs (rnd (B2R P - B2R hi)))).
    { rewrite <- 3!rnd_abs. unfold Rmax. destruct Rle_dec as [D|D].
      - destruct (Rle_or_lt (Rabs (B2R P - B2R xx)) (Rabs (B2R P - B2R hi))) as [K|K]; [now apply rnd_le|].
        eapply Rle_trans; [|exact D]. apply rnd_le. revert K. unfold Rabs. repeat destruct Rcase_abs; lra.
      - apply Rnot_le_lt in D.
        destruct (Rle_or_lt (Rabs (B2R P - B2R xx)) (Rabs (B2R P - B2R lo))) as [K|K]; [now apply rnd_le|].
        eapply Rle_trans; [|apply Rlt_le; exact D]. apply rnd_le. revert K. unfold Rabs. repeat destruct Rcase_abs; lra. }
    assert (G : is_finite (Bminus mode_NE P xx : float) = true).
    { apply minus_in_range; auto. eapply Rle_lt_trans; [exact L2|].
      apply Rmax_lub_lt; rewrite <- minus_value by assumption; apply B2R_bounded. }
    split; [exact G|]. rewrite (minus_value _ _ G).
    rewrite (Bcompare_correct prec emax) in F |- * by (rewrite is_finite_Babs; assumption).
    rewrite 2!B2R_Babs, (minus_value _ _ F1), (minus_value _ _ F2) in *. revert L2.
    unfold Rmax. destruct Rle_dec; case Rcompare_spec; intros; rewrite B2R_Babs; rewrite ?minus_value by assumption; lra.
  - exfalso. revert F F1 F2. generalize (Bminus mode_NE P lo) (Bminus mode_NE P hi).
    intros [[]|[]| |[] ? ? ?] [[]|[]| |[] ? ? ?]; simpl; intros; discriminate.
  - exfalso. revert F F1 F2. generalize (Bminus mode_NE P lo) (Bminus mode_NE P hi).
    intros [[]|[]| |[] ? ? ?] [[]|[]| |[] ? ? ?]; simpl; intros; discriminate.
  - exfalso. revert F F1 F2. generalize (Bminus mode_NE P lo) (Bminus mode_NE P hi).
    intros [[]|[]| |[] ? ? ?] [[]|[]| |[] ? ? ?]; simpl; intros; discriminate.
Qed.

Lemma bound_of_code v p w pm wm :
  above (eval v p) (eval v pm) ->
  above (eval v (X w)) (eval v (X wm)) -> above (eval v (Y w)) (eval v (Y wm)) ->
  above (eval v (Z' w)) (eval v (Z' wm)) ->
  above (eval v (tbound p w)) (eval v (tbound pm wm)).
Proof.
  intros H Hx Hy Hz. unfold tbound. cbn [eval].
  repeat first [apply above_plus | apply above_mult]; auto; apply above_same;
    now right.
Qed.

(** One component of three vectors: the largest is above that of each. *)
Lemma above_largest p q s x : not_negative p -> not_negative q -> not_negative s ->
  above p x \/ above q x \/ above s x -> above (fmax (fmax p q) s) x.
Proof.
  intros P Q S H. apply above_max; auto using not_negative_max.
  destruct H as [H|[H|H]]; auto; left; apply above_max; auto.
Qed.

Ltac not_neg :=
  repeat first [apply not_negative_plus | apply not_negative_mult | apply not_negative_abs].

Ltac by_above := cbn [eval];
  first
    [ assumption
    | apply above_abs_self
    | apply above_same; not_neg; fail
    | apply above_largest; [not_neg | not_neg | not_neg | first [left; by_above | right; left; by_above | right; right; by_above]]
    | apply above_box; assumption
    | apply above_plus; by_above
    | apply above_minus; by_above
    | apply above_mult; by_above
    | apply above_mult_swapped; by_above
    | apply above_abs; by_above ].

Ltac names :=
  unfold dominates, edge_from_point, edge_parallel, size_of_edge, of_n, size_of_n, T_of, D_of, T_plane, D_plane,
    one_edge, one_T, one_D, one_parallel, one_T_plane, one_D_plane, tdot, tcross, tsize, tlargest3, largest3,
    tmax, tabs, tsub, far, arm, ab, ac, X, Y, Z', fst, snd in *.

(** ** Every pair of a number and its bound *)

Section Pairs.
Variable v : env.

Lemma above_sign p x : above p x -> not_negative p. Proof. now intros [H _]. Qed.
Ltac by_sign := cbn [eval];
  first [ apply not_negative_abs | apply not_negative_max; by_sign
        | eapply above_sign; eassumption ].

Ltac pair this off :=
  apply bounds_by with (one := this);
  [ names; by_above
  | names; by_sign | names; by_sign | names; by_sign
  | apply bound_of_code; names; by_above
  | reflexivity | reflexivity
  | apply off, real_env_floats ].

Theorem from_point_e : within_reach v ->
  bounds v E_from_point (edge_from_point a b) /\ bounds v E_from_point (edge_from_point b c) /\
  bounds v E_from_point (edge_from_point c a).
Proof.
  intros [Rx [Ry Rz]]. unfold dominates in *. split; [|split].
  - pair (one_edge a b) edge_ab_off.
  - pair (one_edge b c) edge_bc_off.
  - pair (one_edge c a) edge_ca_off.
Qed.

Definition E_T_from_point := one_T.
Theorem from_point_T : bounds v E_T_from_point T_of.
Proof. unfold E_T_from_point, one_T. pair one_T T_off. Qed.

Theorem from_point_D : within_reach v -> bounds v E_D_from_point D_of.
Proof. intros [Rx [Ry Rz]]. unfold dominates in *. pair one_D D_off. Qed.

Lemma not_negative_bound p w : not_negative (eval v p) -> not_negative (eval v (X w)) ->
  not_negative (eval v (Y w)) -> not_negative (eval v (Z' w)) -> not_negative (eval v (tbound p w)).
Proof.
  intros. apply (bound_of_code v p w p w); now apply above_same.
Qed.

Lemma parallel_not_negative p q : not_negative (eval v (E_parallel_edge p q)).
Proof.
  unfold E_parallel_edge. apply not_negative_bound; names; cbn [eval];
    repeat first [apply not_negative_plus | apply not_negative_mult | apply not_negative_max | apply not_negative_abs].
Qed.

Theorem parallel_e : within_box v ->
  bounds v E_parallel (edge_parallel a b) /\ bounds v E_parallel (edge_parallel b c) /\
  bounds v E_parallel (edge_parallel c a).
Proof.
  intros [Bx [By Bz]]. unfold E_parallel, largest3.
  assert (K : forall p q, not_negative (eval v (E_parallel_edge p q))) by (intros; apply parallel_not_negative).
  split; [|split].
  - apply bounds_max; [apply not_negative_max; apply K | apply K |]. left.
    apply bounds_max; try apply K. left. unfold E_parallel_edge. pair (one_parallel a b) parallel_ab_off.
  - apply bounds_max; [apply not_negative_max; apply K | apply K |]. left.
    apply bounds_max; try apply K. right. unfold E_parallel_edge. pair (one_parallel b c) parallel_bc_off.
  - apply bounds_max; [apply not_negative_max; apply K | apply K |]. right.
    unfold E_parallel_edge. pair (one_parallel c a) parallel_ca_off.
Qed.

Theorem parallel_T : within_box v -> bounds v E_T_parallel T_of.
Proof. intros [Bx [By Bz]]. unfold E_T_parallel. pair one_T T_off. Qed.

Definition E_D_parallel := one_D.
Theorem parallel_D : bounds v E_D_parallel D_of.
Proof. unfold E_D_parallel, one_D. pair one_D D_off. Qed.

Theorem plane_T : bounds v one_T_plane T_plane.
Proof. unfold one_T_plane. pair one_T_plane T_plane_off. Qed.

Theorem plane_D : bounds v one_D_plane D_plane.
Proof. unfold one_D_plane. pair one_D_plane D_plane_off. Qed.

(** ** What these expressions are worth exactly *)

Notation triangle_ := (Triangle (real_vec v "a") (real_vec v "b") (real_vec v "c")).
Ltac exactly := cbv -[Rplus Rmult Rminus Ropp B2R of_var]; ring.

Lemma exact_from_point :
  ex (real_env v) (edge_from_point a b) = edge (real_ray v) (real_vec v "a") (real_vec v "b") /\
  ex (real_env v) (edge_from_point b c) = edge (real_ray v) (real_vec v "b") (real_vec v "c") /\
  ex (real_env v) (edge_from_point c a) = edge (real_ray v) (real_vec v "c") (real_vec v "a").
Proof. repeat split; exactly. Qed.
Lemma exact_parallel :
  ex (real_env v) (edge_parallel a b) = edge (real_ray v) (real_vec v "a") (real_vec v "b") /\
  ex (real_env v) (edge_parallel b c) = edge (real_ray v) (real_vec v "b") (real_vec v "c") /\
  ex (real_env v) (edge_parallel c a) = edge (real_ray v) (real_vec v "c") (real_vec v "a").
Proof. repeat split; exactly. Qed.
Lemma exact_T : ex (real_env v) T_of = numerator (real_ray v) triangle_. Proof. exactly. Qed.
Lemma exact_D : ex (real_env v) D_of = denominator (real_ray v) triangle_. Proof. exactly. Qed.
Lemma exact_T_plane : ex (real_env v) T_plane =
  dot (vsub (real_vec v "p") (real_vec v "o")) (real_vec v "n").
Proof. exactly. Qed.
Lemma exact_D_plane : ex (real_env v) D_plane = dot (real_vec v "d") (real_vec v "n").
Proof. exactly. Qed.
End Pairs.
