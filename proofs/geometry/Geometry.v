(** What exact arithmetic says of a ray and a triangle: the definitions that all else is about.

    Corners, origins and directions are vectors of real numbers. A float is a real number, so they
    are the stored ones. See "How floats get it wrong" in docs/accuracy.md. *)
Require Import Reals Psatz.
Open Scope R_scope.

Record vec := V { vx : R; vy : R; vz : R }.

Definition vadd u v := V (vx u + vx v) (vy u + vy v) (vz u + vz v).
Definition vsub u v := V (vx u - vx v) (vy u - vy v) (vz u - vz v).
Definition vscale s v := V (s * vx v) (s * vy v) (s * vz v).
Definition dot u v := vx u * vx v + vy u * vy v + vz u * vz v.
Definition cross u v :=
  V (vy u * vz v - vz u * vy v) (vz u * vx v - vx u * vz v) (vx u * vy v - vy u * vx v).
Definition det u v w := dot (cross u v) w.

Record ray := Ray { origin : vec; direction : vec }.
Record triangle := Triangle { ca : vec; cb : vec; cc : vec }.

(** e_ab = d . ((a - o) x (b - a)), in the form that the tracer computes. *)
Definition edge (r : ray) (a b : vec) : R :=
  dot (direction r) (cross (vsub a (origin r)) (vsub b a)).
Definition normal (s : triangle) : vec := cross (vsub (cb s) (ca s)) (vsub (cc s) (ca s)).
Definition numerator (r : ray) (s : triangle) : R := dot (vsub (ca s) (origin r)) (normal s).
Definition denominator (r : ray) (s : triangle) : R := dot (direction r) (normal s).

(** The other form, d . ((a - o) x (b - o)), has the same value. *)
Lemma edge_other r a b :
  edge r a b = dot (direction r) (cross (vsub a (origin r)) (vsub b (origin r))).
Proof. unfold edge, dot, cross, vsub; simpl; ring. Qed.

(** D is the sum of the three edge functions. *)
Lemma denominator_sum r s :
  denominator r s = edge r (ca s) (cb s) + edge r (cb s) (cc s) + edge r (cc s) (ca s).
Proof. unfold denominator, normal, edge, dot, cross, vsub; simpl; ring. Qed.

(** The line of the ray meets the closed triangle, not edge-on: all e have one sign, and D is not 0. *)
Definition meets (r : ray) (s : triangle) : Prop :=
  denominator r s <> 0 /\
  ((0 <= edge r (ca s) (cb s) /\ 0 <= edge r (cb s) (cc s) /\ 0 <= edge r (cc s) (ca s)) \/
   (edge r (ca s) (cb s) <= 0 /\ edge r (cb s) (cc s) <= 0 /\ edge r (cc s) (ca s) <= 0)).

(** It does at no edge: then no rule is asked. *)
Definition meets_inside (r : ray) (s : triangle) : Prop :=
  (0 < edge r (ca s) (cb s) /\ 0 < edge r (cb s) (cc s) /\ 0 < edge r (cc s) (ca s)) \/
  (edge r (ca s) (cb s) < 0 /\ edge r (cb s) (cc s) < 0 /\ edge r (cc s) (ca s) < 0).

(** Where: at the parameter t = T / D. *)
Definition depth (r : ray) (s : triangle) : R := numerator r s / denominator r s.
Definition at_ (r : ray) (t : R) : vec := vadd (origin r) (vscale t (direction r)).

(** That is right: the point at t = T / D is the combination of the corners with the weights
    e_bc / D, e_ca / D, e_ab / D, which sum to 1. *)
Theorem meets_at r s : denominator r s <> 0 ->
  let D := denominator r s in
  at_ r (depth r s) =
  vadd (vscale (edge r (cb s) (cc s) / D) (ca s))
       (vadd (vscale (edge r (cc s) (ca s) / D) (cb s)) (vscale (edge r (ca s) (cb s) / D) (cc s))).
Proof.
  intros H D. unfold at_, depth. fold D in H |- *.
  destruct r as [[ox oy oz] [dx dy dz]], s as [[ax ay az] [bx by_ bz] [cx cy cz]].
  unfold vadd, vscale; simpl.
  f_equal; apply (Rmult_eq_reg_l D); try exact H; field_simplify; try exact H;
    unfold D, denominator, numerator, normal, edge, dot, cross, vsub; simpl; ring.
Qed.
