(** The recorded `set_up` of edge_functions.py is what EdgeBounds.v and NearnessCommon.v speak of.

    RecordedEdges.v has the expressions that a test has seen `set_up` execute. Here: what each of them
    comes to, in real numbers with a rounding at every operation, is the formula of that name. So the
    theorems about the formulas are theorems about the code; SweepPixels.v has what is asked at a
    pixel, SweepProven.v the theorems themselves. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees RecordedEdges Rounding EdgeFunctions.
From Reftrace Require Import NearnessCommon.
Open Scope R_scope.
Open Scope string_scope.

(** ** The numbers in the code *)

Lemma num_0 : IZR 0 * bpow radix2 0 = 0. Proof. simpl. lra. Qed.
Lemma num_1 : IZR 1 * bpow radix2 0 = 1. Proof. simpl. lra. Qed.
Lemma num_minus_1 : IZR (-1) * bpow radix2 0 = -1. Proof. simpl. lra. Qed.
Lemma num_2 : IZR 1 * bpow radix2 1 = 2. Proof. simpl. lra. Qed.
Lemma num_4 : IZR 1 * bpow radix2 2 = 4. Proof. simpl. lra. Qed.
Lemma num_6 : IZR 3 * bpow radix2 1 = 6. Proof. simpl. lra. Qed.
Lemma num_half : IZR 1 * bpow radix2 (-1) = / 2. Proof. simpl. lra. Qed.
Lemma num_8u : IZR 1 * bpow radix2 (-50) = 8 * u. Proof. unfold u. simpl. lra. Qed.
Lemma num_16u : IZR 1 * bpow radix2 (-49) = 16 * u. Proof. unfold u. simpl. lra. Qed.
Lemma num_50u : IZR 25 * bpow radix2 (-52) = 50 * u. Proof. unfold u. simpl. lra. Qed.
Lemma num_tiny : IZR 1 * bpow radix2 (-1000) = tiny. Proof. unfold tiny. ring. Qed.
Lemma num_more : IZR 4548635623644201 * bpow radix2 (-52) = more. Proof. reflexivity. Qed.
Lemma num_huge : IZR 1 * bpow radix2 1000 = bpow radix2 1000. Proof. ring. Qed.
Lemma num_room_up : IZR 2251799813685249 * bpow radix2 (-51) = 1 + 4 * u.
Proof. unfold u. simpl. lra. Qed.
Lemma num_room_down : IZR 2251799813685247 * bpow radix2 (-51) = 1 - 4 * u.
Proof. unfold u. simpl. lra. Qed.

Ltac numbers := rewrite ?num_0, ?num_1, ?num_minus_1, ?num_2, ?num_4, ?num_6, ?num_half, ?num_8u,
  ?num_16u, ?num_50u, ?num_tiny, ?num_more, ?num_huge, ?num_room_up, ?num_room_down.

Lemma true_less x y : Rlt_bool x y = true <-> x < y.
Proof. case Rlt_bool_spec; split; intros; auto; [discriminate | lra]. Qed.
Lemma true_less_eq x y : Rle_bool x y = true <-> x <= y.
Proof. case Rle_bool_spec; split; intros; auto; [discriminate | lra]. Qed.

(** ** The variables of `set_up` *)

Section SetUp.
Variable v : renv.
Notation var := (r_var v).

(** The middle of the pixel that the functions count from, and the corners from there on. *)
Definition x_0 : R := rnd (var "x0" + / 2).
Definition y_0 : R := rnd (var "y0" + / 2).
Definition corner_a : vec := relative x_0 y_0 (V (var "pa") (var "qa") (var "wa")).
Definition corner_b : vec := relative x_0 y_0 (V (var "pb") (var "qb") (var "wb")).
Definition corner_c : vec := relative x_0 y_0 (V (var "pc") (var "qc") (var "wc")).

(** The bounds of the film, for a triangle with vertices of these sizes. *)
Definition size : R := Rmax (Rmax (var "sa") (var "sb")) (var "sc").
Definition place_ : R := rnd (var "c0" + rnd (var "c1" * size)).
Definition weight_ : R := rnd (var "weight" * size).
Definition own_ : R := rnd (var "d0" + rnd (var "d1" * size)).
Definition reach_ : R := var "reach".

Notation a := corner_a. Notation b := corner_b. Notation c := corner_c.
Definition far_ : R := far_of (span a b c) place_.
Definition high_ : R := high_of (top a b c) weight_.
Definition e_max : R := edge_error reach_ place_ weight_ far_ high_.
Definition t_max : R := volume_error place_ weight_ far_ high_.
Definition T_ : R := volume a b c.
Definition amount_ : R := Rabs T_.
Definition s_ : R := sign_of T_.
Definition b_depth : R := rnd (var "tb" - var "ta").
Definition c_depth : R := rnd (var "tc" - var "ta").
Definition terms_ : R := terms_of reach_ far_ high_.
Definition terms_parallel : R := rnd (terms_ *
  Rmax (Rmax (Rmax (Rmax (Rmax (Rabs (var "ta")) (Rabs (var "tb"))) (Rabs (var "tc")))
    (Rabs b_depth)) (Rabs c_depth)) 1).

Ltac formulas := cbv [e_max t_max far_ high_ far_of high_of T_ amount_ s_ sign_of volume edge_error
  volume_error terms_of terms_parallel terms_ span top largest6 of_1 of_y of_x corner_a corner_b corner_c
  relative x_0 y_0 size place_ weight_ own_ reach_ b_depth c_depth coefficient coefficient_p summed mixed
  perspective_error parallel_error vx vy vz].
Ltac same x := unfold x; cbn [value truth]; numbers; formulas; reflexivity.

(** ** Perspective *)

Theorem set_up_perspective_sign :
  fl v set_up_perspective_T = T_ /\ fl v set_up_perspective_T_error = t_max /\
  (truth rnd v set_up_perspective_sure = true <-> amount_ > t_max).
Proof.
  split; [same set_up_perspective_T|]. split; [same set_up_perspective_T_error|].
  rewrite <- (true_less t_max amount_), <- (andb_true_r (Rlt_bool _ _)).
  apply eq_iff_eq_true. same set_up_perspective_sure.
Qed.

Theorem set_up_perspective_edges :
  fl v set_up_perspective_bc_1 = rnd (of_1 b c * s_) /\
  fl v set_up_perspective_bc_y = rnd (of_y b c * s_) /\
  fl v set_up_perspective_bc_x = rnd (of_x b c * s_) /\
  fl v set_up_perspective_ca_1 = rnd (of_1 c a * s_) /\
  fl v set_up_perspective_ca_y = rnd (of_y c a * s_) /\
  fl v set_up_perspective_ca_x = rnd (of_x c a * s_) /\
  fl v set_up_perspective_ab_1 = rnd (of_1 a b * s_) /\
  fl v set_up_perspective_ab_y = rnd (of_y a b * s_) /\
  fl v set_up_perspective_ab_x = rnd (of_x a b * s_) /\
  fl v set_up_perspective_edge_error = e_max.
Proof.
  split; [same set_up_perspective_bc_1|]. split; [same set_up_perspective_bc_y|].
  split; [same set_up_perspective_bc_x|]. split; [same set_up_perspective_ca_1|].
  split; [same set_up_perspective_ca_y|]. split; [same set_up_perspective_ca_x|].
  split; [same set_up_perspective_ab_1|]. split; [same set_up_perspective_ab_y|].
  split; [same set_up_perspective_ab_x|]. same set_up_perspective_edge_error.
Qed.

Theorem set_up_perspective_nearness :
  fl v set_up_perspective_nearness_1 = coefficient a b c of_1 /\
  fl v set_up_perspective_nearness_y = coefficient a b c of_y /\
  fl v set_up_perspective_nearness_x = coefficient a b c of_x /\
  fl v set_up_perspective_nearness_error
    = perspective_error e_max t_max amount_ (var "ray_error") (var "nearest").
Proof.
  split; [same set_up_perspective_nearness_1|]. split; [same set_up_perspective_nearness_y|].
  split; [same set_up_perspective_nearness_x|]. same set_up_perspective_nearness_error.
Qed.

(** The record's way through the code: nothing is too large, and T is sure. *)
Theorem set_up_perspective_path_right :
  truth rnd v set_up_perspective_path = true <-> terms_ < bpow radix2 1000 /\ amount_ > t_max.
Proof.
  assert (E : truth rnd v set_up_perspective_path
    = (negb (negb (Rlt_bool terms_ (bpow radix2 1000))) && negb (negb (Rlt_bool t_max amount_ && true)))%bool)
    by same set_up_perspective_path.
  rewrite E, !negb_involutive, andb_true_r, andb_true_iff, !true_less. reflexivity.
Qed.

(** ** Parallel rays: the edges are the same expressions *)

Lemma parallel_is_perspective :
  set_up_parallel_bc_1 = set_up_perspective_bc_1 /\ set_up_parallel_bc_y = set_up_perspective_bc_y /\
  set_up_parallel_bc_x = set_up_perspective_bc_x /\ set_up_parallel_ca_1 = set_up_perspective_ca_1 /\
  set_up_parallel_ca_y = set_up_perspective_ca_y /\ set_up_parallel_ca_x = set_up_perspective_ca_x /\
  set_up_parallel_ab_1 = set_up_perspective_ab_1 /\ set_up_parallel_ab_y = set_up_perspective_ab_y /\
  set_up_parallel_ab_x = set_up_perspective_ab_x /\ set_up_parallel_T = set_up_perspective_T /\
  set_up_parallel_edge_error = set_up_perspective_edge_error /\
  set_up_parallel_T_error = set_up_perspective_T_error /\ set_up_parallel_sure = set_up_perspective_sure.
Proof. repeat split. Qed.

Theorem set_up_parallel_sign :
  fl v set_up_parallel_T = T_ /\ fl v set_up_parallel_T_error = t_max /\
  (truth rnd v set_up_parallel_sure = true <-> amount_ > t_max).
Proof. exact set_up_perspective_sign. Qed.

Theorem set_up_parallel_edges :
  fl v set_up_parallel_bc_1 = rnd (of_1 b c * s_) /\ fl v set_up_parallel_bc_y = rnd (of_y b c * s_) /\
  fl v set_up_parallel_bc_x = rnd (of_x b c * s_) /\ fl v set_up_parallel_ca_1 = rnd (of_1 c a * s_) /\
  fl v set_up_parallel_ca_y = rnd (of_y c a * s_) /\ fl v set_up_parallel_ca_x = rnd (of_x c a * s_) /\
  fl v set_up_parallel_ab_1 = rnd (of_1 a b * s_) /\ fl v set_up_parallel_ab_y = rnd (of_y a b * s_) /\
  fl v set_up_parallel_ab_x = rnd (of_x a b * s_) /\ fl v set_up_parallel_edge_error = e_max.
Proof. exact set_up_perspective_edges. Qed.

Theorem set_up_parallel_nearness :
  fl v set_up_parallel_nearness_1
    = rnd (coefficient_p a b c (var "ta") (var "tb") (var "tc") of_1 - var "ta") /\
  fl v set_up_parallel_nearness_y = coefficient_p a b c (var "ta") (var "tb") (var "tc") of_y /\
  fl v set_up_parallel_nearness_x = coefficient_p a b c (var "ta") (var "tb") (var "tc") of_x /\
  fl v set_up_parallel_nearness_error = parallel_error e_max t_max amount_ b_depth c_depth own_.
Proof.
  split; [same set_up_parallel_nearness_1|]. split; [same set_up_parallel_nearness_y|].
  split; [same set_up_parallel_nearness_x|]. same set_up_parallel_nearness_error.
Qed.

Theorem set_up_parallel_path_right :
  truth rnd v set_up_parallel_path = true <-> terms_parallel < bpow radix2 1000 /\ amount_ > t_max.
Proof.
  assert (E : truth rnd v set_up_parallel_path = (negb (negb (Rlt_bool terms_parallel (bpow radix2 1000)))
    && negb (negb (Rlt_bool t_max amount_ && true)))%bool) by same set_up_parallel_path.
  rewrite E, !negb_involutive, andb_true_r, andb_true_iff, !true_less. reflexivity.
Qed.
End SetUp.
