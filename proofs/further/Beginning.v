(** Where the moved ray sees what the stored one does not: why [moved_meets] asks for D <> 0.

    The stored ray begins on a triangle and lies in its plane; the camera sees behind its origin, as
    an orthographic one may. The rule's ray meets the triangle at a t near 0, however little it is
    moved. The tracer does not see it, as D is 0: so the triangle behind is called EXACT. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Contest Facts Nearest Whole Nearby.
Open Scope R_scope.

Definition along : ray := Ray (V 0 0 0) (V 1 0 0).
Definition floor : surface :=
  Surface (0, 0)%Z (Triangular (Triangle (V (-1) (-1) 0) (V 2 (-1) 0) (V (-1) 2 0))).

Example stored_ray_does_not_meet_it : ~ meets_closed along floor.
Proof.
  intros [H _]. apply H. unfold denominator, normal, dot, cross, vsub. simpl. ring.
Qed.

Example moved_ray_meets_it :
  soon (fun by_ =>
    meets_within (moved_ray along by_) floor /\ -1 < t (moved_ray along by_) floor < 1).
Proof.
  exists 1. split; [lra|]. intros x X. exists (x / 2). split; [lra|]. intros y Y.
  assert (X3 : 0 < x * x * x) by (repeat apply Rmult_lt_0_compat; lra).
  assert (Y3 : 0 < y * y * y) by (repeat apply Rmult_lt_0_compat; lra).
  assert (L2 : y * y < x * x / 4) by nra.
  assert (L : y * y * y < x * x * x / 8) by nra.
  assert (M : y * y * y * x <= y * y * y * 1) by (apply Rmult_le_compat_l; lra).
  assert (N : y * y * y * (x * x) <= y * y * y * 1) by (apply Rmult_le_compat_l; [lra | nra]).
  assert (X2 : x * x * x * y < x * x * x * (1 / 2)) by (apply Rmult_lt_compat_l; lra).
  assert (Y2 : y * y < 1 / 4) by nra.
  assert (X4 : x * x * x * (y * y) < x * x * x * (1 / 4)) by (apply Rmult_lt_compat_l; lra).
  assert (P1 : 0 < x * x * x * y) by (apply Rmult_lt_0_compat; lra).
  assert (P2 : 0 < x * x * x * (y * y)) by (apply Rmult_lt_0_compat; nra).
  assert (P3 : 0 < y * y * y * x) by (apply Rmult_lt_0_compat; lra).
  assert (P4 : 0 < y * y * y * (x * x)) by (apply Rmult_lt_0_compat; nra).
  split.
  - left. unfold edge, dot, cross, vsub. simpl. repeat split; lra.
  - unfold t, T, D, numerator, denominator, normal, dot, cross, vsub. simpl.
    match goal with |- _ < ?f < _ => replace f with (- (y * y * y) / (x * x * x)) end.
    + assert (K : - (y * y * y) / (x * x * x) * (x * x * x) = - (y * y * y)) by (field; lra).
      split; apply (Rmult_lt_reg_r (x * x * x)); auto; rewrite K; lra.
    + field. nra.
Qed.
