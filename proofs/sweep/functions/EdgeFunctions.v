(** The edge functions of a triangle: their bounds hold, and what that proves of a pixel.

    See "A triangle as four linear functions of the pixel" and "The bound, and what it proves" in
    docs/speed.md; the code is edge_functions.py, its formulas are in EdgeBounds.v. A corner is a vector
    (p, q, w). What Film.v says: for the stored ray of a pixel there are exact corners a', b', c', off
    by at most [place] in p and q and by [weight] in w, for which the exact edge functions have the
    signs of the determinants below. Here: how far what is computed may be from those determinants. *)
Require Import ZArith Reals Psatz String.
From Flocq Require Import Core Mult_error.
From Reftrace Require Import Geometry Trees Rounding.
From Reftrace Require Export EdgeBounds EdgeRoundings.
Open Scope R_scope.

(** ** The bounds hold *)

(** What is asked of the inputs. Of the film: the bounds are floats, and not tiny. Of the corners a,
    b, c, relative to the first pixel, as computed: they are off from the exact ones by no more than
    place and weight. That has to include the roundings of p - x0 w itself. Of the box: its size. *)
Record fit (place weight reach : R) (a b c a' b' c' : vec) : Prop := {
  f_place : is_float place; f_weight : is_float weight; f_reach : is_float reach;
  f_a : float_vec a; f_b : float_vec b; f_c : float_vec c;
  pos_place : 0 <= place; pos_weight : 0 <= weight; size_reach : 1 <= reach <= 4294967296;
  not_tiny : bpow radix2 (-1009) <= top a b c + weight;
  place_not_tiny : top a b c + weight <= bpow radix2 60 * place;
  room_a : close place weight a a'; room_b : close place weight b b'; room_c : close place weight c c' }.

Lemma fit_turn place weight reach a b c a' b' c' :
  fit place weight reach a b c a' b' c' -> within (span a b c) (top a b c) a /\
  within (span a b c) (top a b c) b /\ within (span a b c) (top a b c) c /\
  is_float (span a b c) /\ is_float (top a b c) /\ 0 <= span a b c /\ 0 <= top a b c.
Proof.
  intros H. assert (Q : forall x y, x <= Rmax x y /\ y <= Rmax x y) by (intros; split;
    [apply Rmax_l | apply Rmax_r]).
  unfold within, span, top, largest6.
  assert (L : forall x y z, x <= y -> x <= Rmax y z) by (intros; eapply Rle_trans;
    [eassumption | apply Rmax_l]).
  assert (F : forall x y, is_float x -> is_float y -> is_float (Rmax x y)).
  { intros x y X Y. unfold Rmax. destruct (Rle_dec x y); auto. }
  destruct (f_a _ _ _ _ _ _ _ _ _ H) as [? [? ?]], (f_b _ _ _ _ _ _ _ _ _ H) as [? [? ?]],
    (f_c _ _ _ _ _ _ _ _ _ H) as [? [? ?]].
  repeat split; try solve [repeat first [apply Rmax_r | apply Rle_refl | apply L]];
    repeat apply F; auto using is_float_abs;
    (eapply Rle_trans; [apply Rabs_pos | repeat first [apply Rmax_r | apply L]]).
Qed.

Section Bound.
Variables (place weight reach : R) (a b c a' b' c' : vec).
Hypothesis ok : fit place weight reach a b c a' b' c'.
Let far := far_of (span a b c) place.
Let high := high_of (top a b c) weight.
Let e_max := edge_error reach place weight far high.
Let t_max := volume_error place weight far high.

Lemma edge_bound_of v w v' w' up right : float_vec v -> float_vec w ->
  within (span a b c) (top a b c) v -> within (span a b c) (top a b c) w ->
  close place weight v v' -> close place weight w w' ->
  is_float up -> is_float right -> Rabs up <= reach -> Rabs right <= reach ->
  Rabs (edge_at v w up right - det v' w' (pixel_ray up right)) <= e_max.
Proof.
  intros Fv Fw Wv Ww Cv Cw Fu Fr U R. destruct ok.
  destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [_ [_ [_ [Fm [Fk [Pm Pk]]]]]].
  eapply Rle_trans; [|apply edge_error_low; auto].
  assert (E1 := edge_rounding v w up right _ _ reach Fv Fw Fu Fr Wv Ww U R).
  assert (E2 := edge_moved v w v' w' up right _ _ place weight reach pos_place0 pos_weight0 Wv Ww Cv Cw U R).
  simpl in E2. set (m := span a b c) in *. set (k := top a b c) in *.
  set (x := edge_at v w up right) in *. set (y := det v w (pixel_ray up right)) in *.
  replace (x - det v' w' (pixel_ray up right)) with ((x - y) + (y - det v' w' (pixel_ray up right))) by ring.
  eapply Rle_trans; [apply Rabs_triang|].
  assert (Q := u_pos). assert (V := u_small). assert (N := eta_pos). assert (Y := tiny_eta).
  assert (m * k <= (m + place) * (k + weight)) by (apply Rmult_le_compat; lra).
  assert (m * m <= (m + place) * (m + place)) by (apply Rmult_le_compat; lra).
  assert (reach * (m * k) <= reach * ((m + place) * (k + weight))) by (apply Rmult_le_compat_l; lra).
  assert (6 * u * (4 * reach * (m * k) + 2 * (m * m))
    <= 6 * u * (4 * reach * ((m + place) * (k + weight)) + 2 * ((m + place) * (m + place))))
    by (apply Rmult_le_compat_l; lra).
  assert ((1 + 6 * u) * (5 + 4 * reach) * eta <= 2 * 17179869200 * eta).
  { apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat; lra. }
  assert (0 <= place * (k + weight)) by (apply Rmult_le_pos; lra).
  assert (0 <= (m + place) * weight) by (apply Rmult_le_pos; lra).
  assert (0 <= (m + place) * place) by (apply Rmult_le_pos; lra).
  assert (0 <= reach * (place * (k + weight) + (m + place) * weight)) by (apply Rmult_le_pos; lra).
  assert (0 <= (m + place) * (k + weight)) by (apply Rmult_le_pos; lra).
  assert (0 <= reach * ((m + place) * (k + weight))) by (apply Rmult_le_pos; lra).
  assert (0 <= (m + place) * (m + place)) by (apply Rmult_le_pos; lra).
  assert (0 <= u * (4 * reach * ((m + place) * (k + weight)) + 2 * ((m + place) * (m + place))))
    by (apply Rmult_le_pos; lra).
  lra.
Qed.

(** An edge function is off by no more than its bound. *)
Theorem edge_bound up right :
  is_float up -> is_float right -> Rabs up <= reach -> Rabs right <= reach ->
  Rabs (edge_at b c up right - det b' c' (pixel_ray up right)) <= e_max /\
  Rabs (edge_at c a up right - det c' a' (pixel_ray up right)) <= e_max /\
  Rabs (edge_at a b up right - det a' b' (pixel_ray up right)) <= e_max.
Proof.
  intros. destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [Wa [Wb [Wc _]]]. destruct ok.
  repeat split; now apply edge_bound_of.
Qed.

(** T is off by no more than its bound. *)
Theorem volume_bound : Rabs (volume a b c - det a' b' c') <= t_max.
Proof.
  destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [Wa [Wb [Wc [Fm [Fk [Pm Pk]]]]]]. destruct ok.
  assert (E1 := volume_rounding a b c _ _ f_a0 f_b0 f_c0 Wa Wb Wc).
  assert (E2 := volume_moved a b c a' b' c' _ _ place weight pos_place0 pos_weight0 Wa Wb Wc room_a0 room_b0
    room_c0).
  simpl in E2.
  eapply Rle_trans; [|apply volume_error_low; auto].
  assert (Ef := eta_far (span a b c) (top a b c) place weight Pm Pk pos_place0 pos_weight0 not_tiny0).
  assert (Eh := eta_high (span a b c) (top a b c) place weight Pm Pk pos_place0 pos_weight0 place_not_tiny0).
  set (m := span a b c) in *. set (k := top a b c) in *.
  replace (volume a b c - det a' b' c') with ((volume a b c - det a b c) + (det a b c - det a' b' c'))
    by ring.
  eapply Rle_trans; [apply Rabs_triang|].
  assert (Q := u_pos). assert (V := u_small). assert (N := eta_pos). assert (Y := tiny_eta).
  assert (m * m <= (m + place) * (m + place)) by (apply Rmult_le_compat; lra).
  assert (m * m * k <= (m + place) * (m + place) * (k + weight))
    by (apply Rmult_le_compat; try lra; apply Rmult_le_pos; lra).
  assert (u * (m * m * k) <= u * ((m + place) * (m + place) * (k + weight))) by (apply Rmult_le_compat_l;
    lra).
  assert (eta * m <= eta * (m + place)) by (apply Rmult_le_compat_l; lra).
  assert (eta * k <= eta * (k + weight)) by (apply Rmult_le_compat_l; lra).
  assert (0 <= (3 + 4 * m + 2 * k) * eta) by (apply Rmult_le_pos; lra).
  assert ((1 + 6 * u) * ((3 + 4 * m + 2 * k) * eta) <= 2 * ((3 + 4 * m + 2 * k) * eta))
    by (apply Rmult_le_compat_r; lra).
  assert (0 <= place * (k + weight)) by (apply Rmult_le_pos; lra).
  assert (0 <= (m + place) * weight) by (apply Rmult_le_pos; lra).
  assert (0 <= (m + place) * (2 * (place * (k + weight)) + (m + place) * weight)) by (apply Rmult_le_pos;
    lra).
  assert (0 <= m * k) by (apply Rmult_le_pos; lra).
  assert (0 <= m * m * k) by (apply Rmult_le_pos; [apply Rmult_le_pos; lra | lra]).
  lra.
Qed.

(** ** What that proves of a pixel *)

Variables up right : R.
Hypothesis f_up : is_float up. Hypothesis f_right : is_float right.
Hypothesis in_up : Rabs up <= reach. Hypothesis in_right : Rabs right <= reach.
Let d := pixel_ray up right.

Lemma sure_sign s x x' e : s = 1 \/ s = -1 -> Rabs (x - x') <= e ->
  (s * x < - e -> s * x' < 0) /\ (s * x > e -> s * x' > 0).
Proof. intros [-> | ->] H; apply Rabs_le_inv in H; split; lra. Qed.

(** T is sure: its sign is that of the exact one. *)
Theorem sure_volume : Rabs (volume a b c) > t_max -> sign_of (volume a b c) * det a' b' c' > 0.
Proof.
  assert (E := volume_bound). unfold sign_of. apply Rabs_le_inv in E.
  destruct (Rlt_bool_spec (volume a b c) 0) as [H|H].
  - rewrite Rabs_left by easy. lra.
  - rewrite Rabs_pos_eq by easy. lra.
Qed.

Lemma sign_cases x : sign_of x = 1 \/ sign_of x = -1.
Proof. unfold sign_of. destruct (Rlt_bool x 0); auto. Qed.

(** What is below -E is negative, exactly. *)
Theorem sure_outside s : s = 1 \/ s = -1 ->
  (signed_edge s b c up right < - e_max -> s * det b' c' d < 0) /\
  (signed_edge s c a up right < - e_max -> s * det c' a' d < 0) /\
  (signed_edge s a b up right < - e_max -> s * det a' b' d < 0).
Proof.
  intros S. rewrite !signed_edge_sign by easy. destruct (edge_bound up right) as [E1 [E2 E3]]; auto.
  repeat split; now apply sure_sign.
Qed.

(** If all are above E, and T is sure, the exact ones all have the sign of the exact T; so no edge
    and no plane of the triangle is met edge-on, and the sum, which D is a multiple of, is not 0. *)
Theorem sure_inside : let s := sign_of (volume a b c) in let T := det a' b' c' in
  Rabs (volume a b c) > t_max ->
  signed_edge s b c up right > e_max -> signed_edge s c a up right > e_max ->
  signed_edge s a b up right > e_max ->
  T <> 0 /\ T * det b' c' d > 0 /\ T * det c' a' d > 0 /\ T * det a' b' d > 0 /\
  T * (det b' c' d + det c' a' d + det a' b' d) > 0.
Proof.
  intros s T Sure. assert (P := sure_volume Sure). fold s T in P.
  assert (S : s = 1 \/ s = -1) by apply sign_cases.
  rewrite !signed_edge_sign by easy. destruct (edge_bound up right) as [E1 [E2 E3]]; auto.
  fold d in E1, E2, E3.
  intros H1 H2 H3. apply (sure_sign s) in E1, E2, E3; auto.
  destruct E1 as [_ E1], E2 as [_ E2], E3 as [_ E3]. specialize (E1 H1). specialize (E2 H2).
  specialize (E3 H3).
  assert (K : forall x, s * x > 0 -> T * x > 0) by (intros x; destruct S as [E|E]; rewrite E in *; nra).
  repeat split; auto. 1: { intros Z. rewrite Z in P. lra. }
  generalize (K _ E1) (K _ E2) (K _ E3). lra.
Qed.

(** A pixel is dropped where the least of the three is below -E. If T is sure, no ray is lost that
    meets the triangle before the eye, that is, with all e of the sign of T or 0. *)
Theorem nothing_lost : let s := sign_of (volume a b c) in let T := det a' b' c' in
  Rabs (volume a b c) > t_max ->
  Rmin (Rmin (signed_edge s b c up right) (signed_edge s c a up right)) (signed_edge s a b up right) <
    - e_max ->
  ~ (0 <= T * det b' c' d /\ 0 <= T * det c' a' d /\ 0 <= T * det a' b' d).
Proof.
  intros s T Sure. assert (P := sure_volume Sure). fold s T in P.
  assert (S : s = 1 \/ s = -1) by apply sign_cases.
  destruct (sure_outside s S) as [O1 [O2 O3]]. intros L [H1 [H2 H3]].
  assert (K : forall x, s * x < 0 -> 0 <= T * x -> False) by (intros x; destruct S as [E|E]; rewrite E in *;
    nra).
  revert L. apply Rmin_case; [apply Rmin_case|]; eauto.
Qed.

(** If it is not, there are two set-ups, one for each sign. A pixel that both drop has exact edge
    functions of both signs: the line of its ray does not meet the triangle. *)
Theorem nothing_lost_unsure :
  let least s := Rmin (Rmin (signed_edge s b c up right) (signed_edge s c a up right)) (signed_edge s a b up
    right) in
  least 1 < - e_max -> least (-1) < - e_max ->
  ~ (0 <= det b' c' d /\ 0 <= det c' a' d /\ 0 <= det a' b' d) /\
  ~ (det b' c' d <= 0 /\ det c' a' d <= 0 /\ det a' b' d <= 0).
Proof.
  intros least L1 L2.
  destruct (sure_outside 1) as [O1 [O2 O3]]; [now left|].
  destruct (sure_outside (-1)) as [O4 [O5 O6]]; [now right|].
  split; intros [H1 [H2 H3]].
  - revert L1. unfold least. apply Rmin_case; [apply Rmin_case|]; intros L;
      [specialize (O1 L) | specialize (O2 L) | specialize (O3 L)]; lra.
  - revert L2. unfold least. apply Rmin_case; [apply Rmin_case|]; intros L;
      [specialize (O4 L) | specialize (O5 L) | specialize (O6 L)]; lra.
Qed.
End Bound.

(** Counting from another pixel changes no determinant: with p - x0 w and q - y0 w in place of p and
    q, and the pixel counted from there as well, they are the same. *)
Definition moved (x0 y0 : R) (v : vec) : vec := V (vx v - x0 * vz v) (vy v - y0 * vz v) (vz v).
Lemma moved_det x0 y0 a b x y :
  det (moved x0 y0 a) (moved x0 y0 b) (pixel_ray (y - y0) (x - x0)) = det a b (V x y 1).
Proof. unfold det, dot, cross, moved, pixel_ray. simpl. ring. Qed.
Lemma moved_volume x0 y0 a b c : det (moved x0 y0 a) (moved x0 y0 b) (moved x0 y0 c) = det a b c.
Proof. unfold det, dot, cross, moved. simpl. ring. Qed.

(** So what is asked of a corner v as it is stored, and of v' exactly, is this. *)
Definition room_in_place (place weight x0 y0 : R) (v v' : vec) : Prop :=
  close place weight (relative x0 y0 v) (moved x0 y0 v').

