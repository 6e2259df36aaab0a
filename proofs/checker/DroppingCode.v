(** The test by which verify.py drops a surface from a square of pixels, as recorded ([RecordedDropping]):
    signs of eight forms, each of the kind that Room.v is about. *)
Require Import ZArith Reals Psatz String.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Signs.
From Reftrace Require Import RecordedDropping.
From Reftrace Require Import RoomParts.
Open Scope R_scope.
Open Scope string_scope.

(** ** The recorded code is this *)

Definition a := vector_named "a".
Definition b := vector_named "b".
Definition c := vector_named "c".
Definition eye := vector_named "eye".
Definition q := vector_named "q".
Definition tneg (v : tvec) : tvec := (Neg (X v), Neg (Y v), Neg (Z' v)).
Definition ahead := tneg (vector_named "back").
Definition zeros : tvec := (Num 0 0, Num 0 0, Num 0 0).
Definition form_of_cross p k v w := Form p k (tcross v w) (Mul (tmost v) (tmost w)).
Definition n := tcross (tsub b a) (tneg (tsub a c)).
Definition size_n := Mul (tmost (tsub b a)) (tmost (tsub a c)).

(** From a point, r is the direction. *)
Definition numerator_point := Form (tsub a eye) 0 n size_n.
Definition denominator_point := Form zeros 1 n size_n.
Definition edge_point p p' := form_of_cross zeros 1 (tsub p eye) (tsub p' p).
Definition beside_point p := form_of_cross zeros 1 (tsub p eye) q.
(** Of parallel rays it is the origin less the camera's. *)
Definition numerator_parallel := Form (tsub a eye) (-1) n size_n.
Definition denominator_parallel := Form ahead 0 n size_n.
Definition edge_parallel p p' := form_of_cross (tsub p eye) (-1) (tsub p' p) ahead.
Definition beside_parallel p := form_of_cross (tsub p eye) (-1) q ahead.
(** A plane has its point as a, its normal as b. *)
Definition of_plane f := Form (point f) (times f) b (tmost b).

Definition of_form f := (value_of f, reach_of f).
Definition no_edge f := (value_of f, Add Inf (tdot (tabs (slope f)) half)).
Definition after_start (T D : expr * expr) :=
  (Sub (fst T) (Mul (Var "start") (fst D)), Add (snd T) (Mul (Abs (Var "start")) (snd D))).
Definition before_far (T D : expr * expr) :=
  (Sub (Mul (Var "far") (fst D)) (fst T), Add (Mul (Abs (Var "far")) (snd D)) (snd T)).
Definition is_above (e : expr * expr) := And (Finite (Sub (fst e) (snd e))) (Less (snd e) (fst e)).
Definition is_below (e : expr * expr) := And (Finite (Sub (fst e) (snd e))) (Less (fst e) (Neg (snd e))).
Definition all3 f (x y z : expr * expr) := And (And (f x) (f y)) (f z).
Definition any5 f (x y z x' y' : expr * expr) := Or (Or (Or (Or (f x) (f y)) (f z)) (f x')) (f y').
Definition gone T D e1 e2 e3 b1 b2 b3 :=
  let s := after_start T D in let f := before_far T D in
  Or (Or (all3 is_above b1 b2 b3) (all3 is_below b1 b2 b3))
    (And (any5 is_above s f e1 e2 e3) (any5 is_below s f e1 e2 e3)).

Theorem triangle_point_is : gone_triangle_point =
  gone (of_form numerator_point) (of_form denominator_point)
    (of_form (edge_point a b)) (of_form (edge_point b c)) (of_form (edge_point c a))
    (of_form (beside_point a)) (of_form (beside_point b)) (of_form (beside_point c)).
Proof. reflexivity. Qed.
Theorem triangle_parallel_is : gone_triangle_parallel =
  gone (of_form numerator_parallel) (of_form denominator_parallel)
    (of_form (edge_parallel a b)) (of_form (edge_parallel b c)) (of_form (edge_parallel c a))
    (of_form (beside_parallel a)) (of_form (beside_parallel b)) (of_form (beside_parallel c)).
Proof. reflexivity. Qed.
Theorem plane_point_is : gone_plane_point =
  gone (of_form (of_plane numerator_point)) (of_form (of_plane denominator_point))
    (no_edge (edge_point a b)) (no_edge (edge_point b b)) (no_edge (edge_point b a))
    (no_edge (beside_point a)) (no_edge (beside_point b)) (no_edge (beside_point b)).
Proof. reflexivity. Qed.
Theorem plane_parallel_is : gone_plane_parallel =
  gone (of_form (of_plane numerator_parallel)) (of_form (of_plane denominator_parallel))
    (no_edge (edge_parallel a b)) (no_edge (edge_parallel b b)) (no_edge (edge_parallel b a))
    (no_edge (beside_parallel a)) (no_edge (beside_parallel b)) (no_edge (beside_parallel b)).
Proof. reflexivity. Qed.

(** ** All forms are of the kind that Room.v is about *)

Section Forms.
Variable w : renv.
Hypothesis floats_w : forall name, is_float (r_var w name).

Lemma zero_float : is_float (IZR 0 * bpow radix2 0).
Proof. simpl. rewrite Rmult_0_l. apply generic_format_0. Qed.
Lemma atom_neg e : atom w e -> atom w (Neg e).
Proof.
  intros (R & D & M & O). unfold atom. cbn [ring_expr depth mag room value].
  rewrite Rabs_Ropp. now repeat split.
Qed.
Lemma atoms_neg t : atoms w t -> atoms w (tneg t).
Proof. intros (H1 & H2 & H3). repeat split; now apply atom_neg. Qed.
Lemma atoms_named name : atoms w (vector_named name).
Proof. repeat split; auto. Qed.
Lemma atoms_sub s t : atoms w (tsub (vector_named s) (vector_named t)).
Proof. repeat split; auto. Qed.
Lemma atoms_zeros : atoms w zeros.
Proof. repeat split; auto; exact zero_float. Qed.
Lemma most_neg t : exact_most w (tneg t) = exact_most w t.
Proof. unfold exact_most, tneg, most. cbn [X Y Z' fst snd value]. now rewrite !Rabs_Ropp. Qed.
Lemma most_is_float t : atoms w t -> is_float (fl w (tmost t)) /\ 0 <= fl w (tmost t).
Proof.
  intros ((Rx & _) & (Ry & _) & (Rz & _)). cbn [tmost value]. split.
  - unfold Rmax. repeat destruct Rle_dec; apply is_float_abs, (fl_float w floats_w); assumption.
  - eapply Rle_trans; [apply Rabs_pos | apply Rmax_r].
Qed.
Lemma product_low t t' : atoms w t -> atoms w t' ->
  (1 - 4 * u) * (exact_most w t * exact_most w t') - eta <= fl w (Mul (tmost t) (tmost t')) /\
  0 <= fl w (Mul (tmost t) (tmost t')).
Proof.
  intros H H'. assert (U := u_pos). assert (Us := u_small).
  assert (L := most_atoms w floats_w t H). assert (L' := most_atoms w floats_w t' H').
  destruct (most_is_float t H) as [_ Z], (most_is_float t' H') as [_ Z'].
  assert (P := most_pos w t). assert (P' := most_pos w t'). cbn [value].
  set (A := exact_most w t) in *. set (A' := exact_most w t') in *.
  set (m := fl w (tmost t)) in *. set (m' := fl w (tmost t')) in *.
  assert (Q : 0 <= A * A') by (apply Rmult_le_pos; assumption).
  assert (S : (1 - u) * A * ((1 - u) * A') <= m * m') by (apply Rmult_le_compat; try apply Rmult_le_pos; lra).
  assert (R := rnd_low (m * m') ltac:(apply Rmult_le_pos; lra)).
  assert ((1 - u) * ((1 - u) * A * ((1 - u) * A')) <= (1 - u) * (m * m')) by (apply Rmult_le_compat_l; lra).
  assert (0 <= u * (A * A')) by (apply Rmult_le_pos; lra).
  assert (0 <= u * (u * (A * A'))) by (apply Rmult_le_pos; lra).
  assert (u * (u * (u * (A * A'))) <= u * (u * (A * A'))) by nra.
  split; [lra | apply rnd_pos, Rmult_le_pos; lra].
Qed.

Record good (f : form) (M : R) : Prop := {
  few : times f = 0%Z \/ times f = 1%Z \/ times f = (-1)%Z;
  points : atoms w (point f);
  vectors : components w M (vector f);
  M_pos : 0 <= M;
  size_low : (1 - 4 * u) * M - eta <= fl w (size f);
  size_pos : 0 <= fl w (size f) }.
Lemma good_cross p k s t : k = 0%Z \/ k = 1%Z \/ k = (-1)%Z -> atoms w p -> atoms w s -> atoms w t ->
  good (form_of_cross p k s t) (exact_most w s * exact_most w t).
Proof.
  intros K P S T. destruct (product_low s t S T). constructor; auto.
  - now apply cross_components.
  - apply Rmult_le_pos; apply most_pos.
Qed.
Lemma good_normal p k : k = 0%Z \/ k = 1%Z \/ k = (-1)%Z -> atoms w p ->
  good (Form p k n size_n) (exact_most w (tsub b a) * exact_most w (tsub a c)).
Proof.
  intros K P. assert (B := atoms_sub "b" "a"). assert (C := atoms_sub "a" "c").
  destruct (product_low _ _ B C). constructor; auto.
  - rewrite <- (most_neg (tsub a c)). apply cross_components; [exact B | now apply atoms_neg].
  - apply Rmult_le_pos; apply most_pos.
Qed.
Lemma good_plane p k : k = 0%Z \/ k = 1%Z \/ k = (-1)%Z -> atoms w p ->
  good (Form p k b (tmost b)) (exact_most w b).
Proof.
  intros K P. assert (B : atoms w b) by apply atoms_named. assert (L := most_atoms w floats_w b B).
  assert (Q := most_pos w b). assert (U := u_pos). assert (N := eta_pos).
  destruct (most_is_float b B). constructor; auto.
  - now apply atoms_components.
  - cbn [size]. assert (0 <= u * exact_most w b) by (apply Rmult_le_pos; lra). lra.
Qed.
End Forms.
