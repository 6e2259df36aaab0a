(** What `candidates` of verify.py drops from a square of pixels is ruled out for each of its rays, if
    `forms` is right about each function: linear, but for its error. In exact arithmetic: that `error` has
    room for the roundings of both is argued by hand. *)
Require Import Reals Psatz List.
From Reftrace Require Import Geometry.
From Reftrace Require Import Contest Facts Dropped.
Import ListNotations.
Open Scope R_scope.

(** A function of r: constant + slope . r, but for its error, in the box around a square's rays. Its range
    there is value +- reach. *)
Record form := Form { constant : R; slope : vec; error : R }.
Definition vabs (v : vec) : vec := V (Rabs (vx v)) (Rabs (vy v)) (Rabs (vz v)).
Definition in_box (middle half r : vec) : Prop :=
  Rabs (vx r - vx middle) <= vx half /\ Rabs (vy r - vy middle) <= vy half /\
  Rabs (vz r - vz middle) <= vz half.
Definition is_form (middle half : vec) (f : form) (g : vec -> R) : Prop :=
  forall r, in_box middle half r -> Rabs (g r - (constant f + dot (slope f) r)) <= error f.
Definition range (middle half : vec) (f : form) : R * R :=
  (constant f + dot (slope f) middle, error f + dot (vabs (slope f)) half).
Definition within (range : R * R) (x : R) : Prop := Rabs (x - fst range) <= snd range.
Definition above (range : R * R) : Prop := snd range < fst range.
Definition below (range : R * R) : Prop := fst range < - snd range.
Lemma both_sides x y : Rabs x <= y -> - y <= x <= y.
Proof. unfold Rabs. destruct (Rcase_abs x); lra. Qed.
Lemma above_within range x : within range x -> above range -> 0 < x.
Proof. unfold within, above. intros W A. apply both_sides in W. lra. Qed.
Lemma below_within range x : within range x -> below range -> x < 0.
Proof. unfold within, below. intros W A. apply both_sides in W. lra. Qed.

Lemma product_within s x m h : Rabs (x - m) <= h -> Rabs (s * x - s * m) <= Rabs s * h.
Proof.
  intros H. replace (s * x - s * m) with (s * (x - m)) by ring. rewrite Rabs_mult.
  apply Rmult_le_compat_l; [apply Rabs_pos | exact H].
Qed.
Theorem range_right middle half f g r : is_form middle half f g -> in_box middle half r ->
  within (range middle half f) (g r).
Proof.
  intros F B. specialize (F r B). destruct B as (X & Y & Z).
  unfold within, range, dot, vabs in *. cbn [fst snd vx vy vz].
  apply (product_within (vx (slope f))) in X. apply (product_within (vy (slope f))) in Y.
  apply (product_within (vz (slope f))) in Z.
  apply both_sides in F, X, Y, Z. apply Rabs_le. lra.
Qed.

(** T - start D, and far D - T *)
Definition minus_times (x y : R * R) (t : R) : R * R := (fst x - t * fst y, snd x + Rabs t * snd y).
Definition times_minus (x y : R * R) (t : R) : R * R := (t * fst y - fst x, Rabs t * snd y + snd x).
Lemma minus_times_right x y t u v : within x u -> within y v -> within (minus_times x y t) (u - t * v).
Proof.
  unfold within, minus_times. cbn [fst snd]. intros U W. apply (product_within t) in W.
  apply both_sides in U, W. apply Rabs_le. lra.
Qed.
Lemma times_minus_right x y t u v : within x u -> within y v -> within (times_minus x y t) (t * v - u).
Proof.
  unfold within, times_minus. cbn [fst snd]. intros U W. apply (product_within t) in W.
  apply both_sides in U, W. apply Rabs_le. lra.
Qed.

(** The eight functions: T, D, the edges, and beside the plane of the ray and q; two of a plane. *)
Definition edges_of (s : surface) : list (ray -> R) :=
  match shape_of s with
  | Triangular x =>
      [fun r => edge r (ca x) (cb x); fun r => edge r (cb x) (cc x); fun r => edge r (cc x) (ca x)]
  | Infinite _ _ => []
  end.
Definition besides_of (q : vec) (s : surface) : list (ray -> R) :=
  match shape_of s with
  | Triangular x =>
      [fun r => beside r q (ca x); fun r => beside r q (cb x); fun r => beside r q (cc x)]
  | Infinite _ _ => []
  end.
Section Square.
Variables (ray_of : vec -> ray) (s : surface) (q middle half : vec) (start far : R).
Variables (numerator_ denominator_ : form) (edges besides : list form).
Hypothesis numerator_is : is_form middle half numerator_ (fun r => T (ray_of r) s).
Hypothesis denominator_is : is_form middle half denominator_ (fun r => D (ray_of r) s).
Hypothesis edges_are : Forall2 (fun f g => is_form middle half f (fun r => g (ray_of r))) edges (edges_of s).
Hypothesis besides_are :
  Forall2 (fun f g => is_form middle half f (fun r => g (ray_of r))) besides (besides_of q s).

Notation ranged := (range middle half).
Definition looked_at : list (R * R) :=
  minus_times (ranged numerator_) (ranged denominator_) start ::
  times_minus (ranged numerator_) (ranged denominator_) far :: map ranged edges.
Definition gone : Prop :=
  (Exists above looked_at /\ Exists below looked_at) \/
  (besides <> [] /\ (Forall above (map ranged besides) \/ Forall below (map ranged besides))).

Lemma ranges_right forms functions r : in_box middle half r ->
  Forall2 (fun f g => is_form middle half f (fun r => g (ray_of r))) forms functions ->
  Forall2 within (map ranged forms) (map (fun g => g (ray_of r)) functions).
Proof.
  intros B. induction 1 as [|f g forms functions F _ IH]; constructor; [|exact IH].
  exact (range_right middle half f (fun r => g (ray_of r)) r F B).
Qed.
Lemma looked_at_right r : in_box middle half r ->
  Forall2 within looked_at (ends_and_edges (ray_of r) s start far).
Proof.
  intros B. assert (N := range_right middle half _ _ r numerator_is B).
  assert (M := range_right middle half _ _ r denominator_is B). cbv beta in N, M.
  unfold looked_at, ends_and_edges. constructor; [now apply minus_times_right|].
  constructor; [now apply times_minus_right|].
  assert (E := ranges_right _ _ r B edges_are). unfold edges_of in E.
  destruct (shape_of s); exact E.
Qed.
Lemma exists_within (P : R * R -> Prop) (Q : R -> Prop) l k :
  (forall p x, within p x -> P p -> Q x) -> Forall2 within l k -> Exists P l -> exists x, In x k /\ Q x.
Proof.
  intros H. induction 1 as [|p x l k W _ IH]; intros E; [inversion E|].
  inversion E as [? ? A | ? ? A]; subst.
  - exists x. split; [now left | now apply (H p)].
  - destruct (IH A) as (y & Y & R). exists y. split; [now right | exact R].
Qed.
Lemma three l x y z : Forall2 within l [x; y; z] ->
  exists p1 p2 p3, l = [p1; p2; p3] /\ within p1 x /\ within p2 y /\ within p3 z.
Proof.
  intros H. inversion H as [|p1 ? l1 ? W1 H1]; subst. inversion H1 as [|p2 ? l2 ? W2 H2]; subst.
  inversion H2 as [|p3 ? l3 ? W3 H3]; subst. inversion H3; subst. now exists p1, p2, p3.
Qed.
Theorem gone_is_ruled_out r : in_box middle half r -> gone -> ruled_out (ray_of r) s start far.
Proof.
  intros B [[A C]|[N H]].
  - left. assert (L := looked_at_right r B).
    destruct (exists_within _ _ _ _ above_within L A) as (x & X & P).
    destruct (exists_within _ _ _ _ below_within L C) as (y & Y & Q). now exists x, y.
  - right. assert (L := ranges_right _ _ r B besides_are). revert L besides_are. unfold besides_of.
    destruct (shape_of s) as [c|]; cbn [map]; intros L F; [|inversion F; congruence].
    exists q. destruct (three _ _ _ _ L) as (p1 & p2 & p3 & E & W1 & W2 & W3).
    rewrite E, !Forall_cons_iff in H. destruct H as [(H1 & H2 & H3 & _)|(H1 & H2 & H3 & _)]; [left | right].
    + now repeat split; eapply above_within; eassumption.
    + now repeat split; eapply below_within; eassumption.
Qed.
End Square.
