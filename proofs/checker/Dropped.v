(** Which signs rule out that a ray meets a surface: verify.py drops no surface for another reason.

    [Dropping.v] proves that its floats know these signs, where it says that they do. *)
Require Import Reals Psatz List Classical.
From Reftrace Require Import Geometry.
From Reftrace Require Import Contest Facts.
From Reftrace Require Nearest.
Import ListNotations.
Open Scope R_scope.

(** T less the first t times D, the second t times D less T, and the edges. *)
Definition ends_and_edges (r : ray) (s : surface) (first last : R) : list R :=
  T r s - first * D r s :: last * D r s - T r s ::
  match shape_of s with
  | Triangular x => [edge r (ca x) (cb x); edge r (cb x) (cc x); edge r (cc x) (ca x)]
  | Infinite _ _ => []
  end.
Theorem different_signs r s first last x y : meets_closed r s -> first <= t r s <= last ->
  In x (ends_and_edges r s first last) -> In y (ends_and_edges r s first last) -> ~ (0 < x /\ y < 0).
Proof.
  intros M R. assert (N := Nearest.closed_D r s M).
  assert (E : T r s = t r s * D r s) by (unfold t; field; exact N).
  assert (S : (forall z, In z (ends_and_edges r s first last) -> 0 <= z) \/
              (forall z, In z (ends_and_edges r s first last) -> z <= 0)).
  { unfold ends_and_edges. rewrite E. revert M N. unfold meets_closed, D.
    destruct (shape_of s) as [c|p n].
    - rewrite denominator_sum. intros [_ [(A & B & C)|(A & B & C)]] N; [left | right];
        intros z [<-|[<-|[<-|[<-|[<-|[]]]]]]; nra.
    - intros _ N. destruct (Rtotal_order 0 (dot (direction r) n)) as [P|[P|P]]; [left | congruence | right];
        intros z [<-|[<-|[]]]; nra. }
  intros X Y [P Q]. destruct S as [S|S]; [specialize (S y Y) | specialize (S x X)]; lra.
Qed.

(** All corners are on one side of the plane that has the ray and q in it. *)
Definition beside (r : ray) (q corner : vec) : R := dot (direction r) (cross (vsub corner (origin r)) q).
Lemma weighted a b c x y z : 0 <= a -> 0 <= b -> 0 <= c -> 0 < x -> 0 < y -> 0 < z ->
  a * x + b * y + c * z = 0 -> a + b + c = 0.
Proof.
  intros A B C X Y Z E.
  assert (P : 0 <= a * x) by nra. assert (Q : 0 <= b * y) by nra. assert (S : 0 <= c * z) by nra.
  assert (a * x = 0) as F by lra. assert (b * y = 0) as G by lra. assert (c * z = 0) as H by lra.
  apply Rmult_integral in F, G, H. lra.
Qed.
Theorem on_one_side r x q : meets r x ->
  ~ (0 < beside r q (ca x) /\ 0 < beside r q (cb x) /\ 0 < beside r q (cc x)) /\
  ~ (beside r q (ca x) < 0 /\ beside r q (cb x) < 0 /\ beside r q (cc x) < 0).
Proof.
  intros [N M].
  assert (E : edge r (cb x) (cc x) * beside r q (ca x) + edge r (cc x) (ca x) * beside r q (cb x) +
    edge r (ca x) (cb x) * beside r q (cc x) = 0).
  { destruct r as [[ox oy oz] [dx dy dz]], x as [[ax ay az] [bx by_ bz] [cx cy cz]], q as [qx qy qz].
    unfold beside, edge, dot, cross, vsub; simpl. ring. }
  rewrite denominator_sum in N. revert N M E.
  generalize (edge r (ca x) (cb x)) (edge r (cb x) (cc x)) (edge r (cc x) (ca x)).
  generalize (beside r q (ca x)) (beside r q (cb x)) (beside r q (cc x)).
  intros a b c u v w N M E. split; intros (A & B & C); destruct M as [(F & G & H)|(F & G & H)]; apply N.
  - enough (v + w + u = 0) by lra. apply (weighted v w u a b c); lra.
  - enough (- v + - w + - u = 0) by lra. apply (weighted (- v) (- w) (- u) a b c); lra.
  - enough (v + w + u = 0) by lra. apply (weighted v w u (- a) (- b) (- c)); lra.
  - enough (- v + - w + - u = 0) by lra. apply (weighted (- v) (- w) (- u) (- a) (- b) (- c)); lra.
Qed.

(** A surface for which the signs are so is not met up to [far]: what is left has all that the theorem of
    certificates asks for. *)
Definition ruled_out (r : ray) (s : surface) (first last : R) : Prop :=
  (exists x y, In x (ends_and_edges r s first last) /\ In y (ends_and_edges r s first last) /\
     0 < x /\ y < 0) \/
  match shape_of s with
  | Triangular x => exists q,
      (0 < beside r q (ca x) /\ 0 < beside r q (cb x) /\ 0 < beside r q (cc x)) \/
      (beside r q (ca x) < 0 /\ beside r q (cb x) < 0 /\ beside r q (cc x) < 0)
  | Infinite _ _ => False
  end.
Theorem dropped_is_not_met r start end_ scene kept last :
  (forall s, In s scene -> ~ In s kept -> ruled_out r s start last) ->
  forall s, met r start end_ scene s -> t r s <= last -> In s kept.
Proof.
  intros K s (I & M & A & _) B. apply NNPP. intros O.
  destruct (K s I O) as [(x & y & X & Y & P & Q)|H].
  - now apply (different_signs r s start last x y M (conj A B) X Y).
  - revert M H. unfold meets_closed. destruct (shape_of s) as [x|]; [|easy]. intros M [q H].
    destruct (on_one_side r x q M). tauto.
Qed.
