(** Bounds that are computed for the rays of a picture's corner pixels are bounds for all its rays:
    by component, a ray is monotone in x and in y, as rounding is. ([corner_rays] in camera.py, and
    [_prepare] in ladder.py.) *)
Require Import ZArith Reals Psatz List String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Trees Rounding Magnitude Finite Signs Pairs RecordedChoices RecordedCamera.
From Reftrace Require Import CodeAnswers.
Import ListNotations.
Open Scope R_scope.
Open Scope string_scope.

(** ** Monotone functions *)

Definition rising (g : R -> R) := forall x y, x <= y -> g x <= g y.
Definition mono (g : R -> R) := rising g \/ rising (fun x => - g x).
Lemma mono_rising f g : rising f -> mono g -> mono (fun x => f (g x)).
Proof.
  intros F [G|G]; [left | right]; intros x y H; [now apply F, G|].
  specialize (G x y H). assert (f (g y) <= f (g x)) by (apply F; lra). lra.
Qed.
Lemma mono_mult k g : mono g -> mono (fun x => rnd (g x * k)).
Proof.
  intros G. apply (mono_rising rnd); [intros x y; apply rnd_le|].
  destruct (Rle_or_lt 0 k) as [K|K], G as [G|G]; [left | right | right | left]; intros x y H;
    specialize (G x y H); nra.
Qed.
Lemma mono_plus k g : mono g -> mono (fun x => rnd (k + g x)).
Proof. intros G. apply (mono_rising (fun x => rnd (k + x))); auto. intros x y H. apply rnd_le. lra. Qed.
Lemma mono_id : mono (fun x => x).
Proof. left. intros x y H. exact H. Qed.
Lemma mono_between g x0 x x1 : mono g -> x0 <= x <= x1 ->
  exists lo hi, (lo = x0 \/ lo = x1) /\ (hi = x0 \/ hi = x1) /\ g lo <= g x <= g hi.
Proof.
  intros [G|G] [A B]; assert (H := G _ _ A); assert (K := G _ _ B);
    [exists x0, x1 | exists x1, x0]; repeat split; auto; lra.
Qed.

(** A component of the position on the film, along one axis: (left + p w) r; and the whole. *)
Definition part (l w r p : R) : R := rnd (rnd (l + rnd (p * w)) * r).
Lemma part_mono l w r : mono (part l w r).
Proof. apply (mono_mult r (fun p => rnd (l + rnd (p * w)))), mono_plus, (mono_mult w (fun p => p)),
  mono_id. Qed.

Section Component.
Variables l w r b h u : R.
Variable last : R -> R. (* what is done with the sum *)
Hypothesis last_rising : rising last.
Definition component (p q : R) : R := last (rnd (part l w r p + part b h u q)).
Theorem between_corners p0 p p1 q0 q q1 : p0 <= p <= p1 -> q0 <= q <= q1 ->
  exists a a' c c', (a = p0 \/ a = p1) /\ (a' = p0 \/ a' = p1) /\ (c = q0 \/ c = q1) /\ (c' = q0 \/ c' =
    q1) /\
    component a c <= component p q <= component a' c'.
Proof.
  intros P Q. destruct (mono_between _ _ _ _ (part_mono l w r) P) as (a & a' & A & A' & L).
  destruct (mono_between _ _ _ _ (part_mono b h u) Q) as (c & c' & C & C' & K).
  exists a, a', c, c'. repeat split; auto; apply last_rising, rnd_le; lra.
Qed.
End Component.

(** ** In binary64, as recorded *)

Section Camera.
Variable camera : string -> float. (* its variables, the pixel's "region_x", "region_y", "dx", "dy" *)
Definition at_film (p q : float) : env := given (named "px" p (named "py" q camera)).
Notation "'in_camera' e" := (eval (given camera) e) (at level 9).
Definition film_p := in_camera film_position_x.
Definition film_q := in_camera film_position_y.
Definition p0 := in_camera corner_ray_px0. Definition p1 := in_camera corner_ray_px2.
Definition q0 := in_camera corner_ray_py0. Definition q1 := in_camera corner_ray_py1.
(** The four corner pixels' film positions are these. *)
Lemma corners : in_camera corner_ray_px1 = p0 /\ in_camera corner_ray_px3 = p1 /\
  in_camera corner_ray_py2 = q0 /\ in_camera corner_ray_py3 = q1.
Proof. repeat split. Qed.

(** A pixel of the picture: its numbers are from 0 to the size less 1. *)
Definition in_picture : Prop :=
  0 <= B2R (camera "region_x") /\ B2R (camera "region_x") <= B2R (camera "width") - 1 /\
  0 <= B2R (camera "region_y") /\ B2R (camera "region_y") <= B2R (camera "height") - 1.

Lemma half : B2R (num 1 (-1)) = / 2.
Proof. rewrite num_value by easy. simpl. lra. Qed.
Lemma position_between (x size d : float) :
  let first := Bplus mode_NE (num 1 (-1)) d : float in
  let last := Bplus mode_NE (Bminus mode_NE size (num 1 (-1))) d : float in
  let this := Bplus mode_NE (Bplus mode_NE (Bplus mode_NE (num 0 0) x) (num 1 (-1))) d : float in
  is_finite first = true -> is_finite last = true -> is_finite this = true ->
  0 <= B2R x -> B2R x <= B2R size - 1 -> B2R first <= B2R this <= B2R last.
Proof.
  cbv zeta. intros F1 F2 F3 X0 X1. destruct (plus_finite _ _ F2) as [F4 _].
  destruct (plus_finite _ _ F3) as [F5 _]. destruct (plus_finite _ _ F5) as [F6 _].
  rewrite (plus_value _ _ F1), (plus_value _ _ F2), (plus_value _ _ F3), (plus_value _ _ F5),
    (plus_value _ _ F6), (minus_value _ _ F4), half.
  change (B2R (num 0 0)) with 0. rewrite Rplus_0_l, (rnd_id (B2R x)) by apply B2R_is_float.
  assert (Fh : is_float (/ 2)) by (rewrite <- half; apply B2R_is_float).
  split; apply rnd_le, Rplus_le_compat_r.
  - rewrite <- (rnd_id (/ 2)) at 1 by exact Fh. apply rnd_le. lra.
  - apply rnd_le. lra.
Qed.

(** A recorded component of a ray has the value of [component] where it is finite. *)
Variable tree : expr. (* one of a ray's direction, or of its origin *)
Variables l w r b h u : R.
Variable last : R -> R.
Hypothesis last_rising : rising last.
Hypothesis tree_is : forall p q, is_finite (eval (at_film p q) tree) = true ->
  is_finite p = true /\ is_finite q = true /\
  B2R (eval (at_film p q) tree) = component l w r b h u last (B2R p) (B2R q).
Notation at_ p q := (eval (at_film p q) tree).
Hypothesis this_finite : is_finite (at_ film_p film_q) = true.
Hypothesis corner_00 : is_finite (at_ p0 q0) = true.
Hypothesis corner_01 : is_finite (at_ p0 q1) = true.
Hypothesis corner_10 : is_finite (at_ p1 q0) = true.
Hypothesis corner_11 : is_finite (at_ p1 q1) = true.
Hypothesis pixel_inside : in_picture.

Lemma component_between :
  Rmin (Rmin (B2R (at_ p0 q0)) (B2R (at_ p0 q1))) (Rmin (B2R (at_ p1 q0)) (B2R (at_ p1 q1)))
    <= B2R (at_ film_p film_q) <=
  Rmax (Rmax (B2R (at_ p0 q0)) (B2R (at_ p0 q1))) (Rmax (B2R (at_ p1 q0)) (B2R (at_ p1 q1))).
Proof.
  destruct (tree_is _ _ this_finite) as [Fp [Fq ->]]. destruct (tree_is _ _ corner_00) as [F0 [G0 ->]].
  destruct (tree_is _ _ corner_01) as [_ [G1 ->]]. destruct (tree_is _ _ corner_10) as [F1 [_ ->]].
  destruct (tree_is _ _ corner_11) as [_ [_ ->]]. destruct pixel_inside as [X0 [X1 [Y0 Y1]]].
  assert (P := position_between _ _ (camera "dx") F0 F1 Fp X0 X1).
  assert (Q := position_between _ _ (camera "dy") G0 G1 Fq Y0 Y1).
  change (B2R p0 <= B2R film_p <= B2R p1) in P. change (B2R q0 <= B2R film_q <= B2R q1) in Q.
  destruct (between_corners l w r b h u last last_rising _ _ _ _ _ _ P Q)
    as (a & a' & c & c' & A & A' & C & C' & L & K).
  split; [eapply Rle_trans; [|exact L] | eapply Rle_trans; [exact K|]].
  - destruct A as [-> | ->], C as [-> | ->]; unfold Rmin; repeat destruct Rle_dec; lra.
  - destruct A' as [-> | ->], C' as [-> | ->]; unfold Rmax; repeat destruct Rle_dec; lra.
Qed.

(** The largest size of the four, and the least and largest of them. *)
Definition reach_of : float :=
  fmax (fmax (fmax (Babs (at_ p0 q0)) (Babs (at_ p0 q1))) (Babs (at_ p1 q0))) (Babs (at_ p1 q1)).
Definition low_of : float := fmin (fmin (fmin (at_ p0 q0) (at_ p0 q1)) (at_ p1 q0)) (at_ p1 q1).
Definition high_of : float := fmax (fmax (fmax (at_ p0 q0) (at_ p0 q1)) (at_ p1 q0)) (at_ p1 q1).

Lemma fmax_sign (x y : float) : Bsign x = false -> Bsign y = false -> is_finite (fmax x y) = true ->
  Bsign (fmax x y) = false.
Proof. intros X Y. unfold fmax. destruct (Bcompare x y) as [[]|]; auto; discriminate. Qed.

Theorem reach_is : is_finite reach_of = true /\ at_most_in_size (at_ film_p film_q) reach_of.
Proof.
  assert (K := component_between). revert K. unfold at_most_in_size, reach_of.
  set (x := at_ film_p film_q). set (x0 := at_ p0 q0) in *. set (x1 := at_ p0 q1) in *.
  set (x2 := at_ p1 q0) in *. set (x3 := at_ p1 q1) in *. intros K.
  assert (A : forall y : float, is_finite y = true -> is_finite (Babs y) = true) by (intros; now rewrite
    is_finite_Babs).
  destruct (fmax_finite _ _ (A _ corner_00) (A _ corner_01)) as [Fa Va].
  destruct (fmax_finite _ _ Fa (A _ corner_10)) as [Fb Vb].
  destruct (fmax_finite _ _ Fb (A _ corner_11)) as [Fc Vc].
  assert (Sg : forall y : float, is_finite y = true -> Bsign (Babs y) = false).
  { intros y F. now destruct y. }
  split; [exact Fc|]. split.
  - rewrite Vc, Vb, Va, !B2R_Babs. revert K. clear.
    generalize (B2R x) (B2R x0) (B2R x1) (B2R x2) (B2R x3). intros y y0 y1 y2 y3 [L H].
    set (m := Rmax _ _).
    assert (M0 : Rabs y0 <= m) by (unfold m; eauto using Rle_trans, Rmax_l, Rmax_r).
    assert (M1 : Rabs y1 <= m) by (unfold m; eauto using Rle_trans, Rmax_l, Rmax_r).
    assert (M2 : Rabs y2 <= m) by (unfold m; eauto using Rle_trans, Rmax_l, Rmax_r).
    assert (M3 : Rabs y3 <= m) by apply Rmax_r.
    apply Rabs_le_inv in M0, M1, M2, M3. apply Rabs_le. split.
    + eapply Rle_trans; [|exact L]. repeat apply Rmin_glb; lra.
    + eapply Rle_trans; [exact H|]. repeat apply Rmax_lub; lra.
  - repeat apply fmax_sign; auto.
Qed.

Theorem box_is : is_finite low_of = true /\ is_finite high_of = true /\
  no_more low_of (at_ film_p film_q) /\ no_more (at_ film_p film_q) high_of.
Proof.
  assert (K := component_between). unfold no_more, low_of, high_of.
  destruct (fmax_finite _ _ corner_00 corner_01) as [Fa Va].
  destruct (fmax_finite _ _ Fa corner_10) as [Fb Vb]. destruct (fmax_finite _ _ Fb corner_11) as [Fc Vc].
  destruct (fmin_finite _ _ corner_00 corner_01) as [Ga Wa].
  destruct (fmin_finite _ _ Ga corner_10) as [Gb Wb]. destruct (fmin_finite _ _ Gb corner_11) as [Gc Wc].
  split; [exact Gc|]. split; [exact Fc|]. rewrite Vc, Vb, Va, Wc, Wb, Wa.
  rewrite Rmin_assoc, Rmax_assoc in K. exact K.
Qed.
End Camera.
