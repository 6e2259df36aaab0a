(** The recorded `set_up` of edge_functions.py where little is known: T may be 0, or numbers are too large.

    A triangle whose T has no sure sign comes twice, once for each sign, so that what both drop is not
    met; and nothing is said of how near it is. Where numbers may be too large, any pixel is in doubt. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees RecordedEdges Rounding EdgeFunctions SweepCode.
Open Scope R_scope.
Open Scope string_scope.

(** ** The sign of T is not known *)

(** The same expressions as where it is; the other copy is times -1. *)
Lemma edge_on_is_perspective :
  set_up_edge_on_bc_1 = set_up_perspective_bc_1 /\
  set_up_edge_on_bc_y = set_up_perspective_bc_y /\
  set_up_edge_on_bc_x = set_up_perspective_bc_x /\
  set_up_edge_on_ca_1 = set_up_perspective_ca_1 /\
  set_up_edge_on_ca_y = set_up_perspective_ca_y /\
  set_up_edge_on_ca_x = set_up_perspective_ca_x /\
  set_up_edge_on_ab_1 = set_up_perspective_ab_1 /\
  set_up_edge_on_ab_y = set_up_perspective_ab_y /\
  set_up_edge_on_ab_x = set_up_perspective_ab_x /\
  set_up_edge_on_edge_error = set_up_perspective_edge_error /\
  set_up_edge_on_T = set_up_perspective_T /\
  set_up_edge_on_T_error = set_up_perspective_T_error /\
  set_up_edge_on_sure = set_up_perspective_sure /\
  set_up_edge_on_parallel_bc_1 = set_up_perspective_bc_1 /\
  set_up_edge_on_parallel_sure = set_up_perspective_sure.
Proof. repeat split. Qed.
Lemma other_is_minus :
  set_up_edge_on_other_bc_1 = Mul set_up_perspective_bc_1 (Num (-1) 0) /\
  set_up_edge_on_other_bc_y = Mul set_up_perspective_bc_y (Num (-1) 0) /\
  set_up_edge_on_other_bc_x = Mul set_up_perspective_bc_x (Num (-1) 0) /\
  set_up_edge_on_other_ca_1 = Mul set_up_perspective_ca_1 (Num (-1) 0) /\
  set_up_edge_on_other_ca_y = Mul set_up_perspective_ca_y (Num (-1) 0) /\
  set_up_edge_on_other_ca_x = Mul set_up_perspective_ca_x (Num (-1) 0) /\
  set_up_edge_on_other_ab_1 = Mul set_up_perspective_ab_1 (Num (-1) 0) /\
  set_up_edge_on_other_ab_y = Mul set_up_perspective_ab_y (Num (-1) 0) /\
  set_up_edge_on_other_ab_x = Mul set_up_perspective_ab_x (Num (-1) 0) /\
  set_up_edge_on_parallel_other_bc_1 = Mul set_up_perspective_bc_1 (Num (-1) 0) /\
  set_up_edge_on_other_edge_error = set_up_perspective_edge_error /\
  set_up_edge_on_other_sure = set_up_perspective_sure.
Proof. repeat split. Qed.

Section EdgeOn.
Variable v : renv.
Notation a := (corner_a v). Notation b := (corner_b v). Notation c := (corner_c v).

(** Of one sign, and of the other. *)
Lemma times_minus_1 x s : s = 1 \/ s = -1 -> rnd (rnd (x * s) * -1) = rnd (x * - s).
Proof.
  intros _. replace (rnd (x * s) * -1) with (- rnd (x * s)) by ring.
  rewrite rnd_opp, rnd_id by apply rnd_float. rewrite <- rnd_opp. f_equal. ring.
Qed.

Theorem set_up_edge_on_edges :
  fl v set_up_edge_on_bc_1 = rnd (of_1 b c * s_ v) /\
  fl v set_up_edge_on_bc_y = rnd (of_y b c * s_ v) /\
  fl v set_up_edge_on_bc_x = rnd (of_x b c * s_ v) /\
  fl v set_up_edge_on_ca_1 = rnd (of_1 c a * s_ v) /\
  fl v set_up_edge_on_ca_y = rnd (of_y c a * s_ v) /\
  fl v set_up_edge_on_ca_x = rnd (of_x c a * s_ v) /\
  fl v set_up_edge_on_ab_1 = rnd (of_1 a b * s_ v) /\
  fl v set_up_edge_on_ab_y = rnd (of_y a b * s_ v) /\
  fl v set_up_edge_on_ab_x = rnd (of_x a b * s_ v) /\
  fl v set_up_edge_on_edge_error = e_max v.
Proof. exact (set_up_perspective_edges v). Qed.

Theorem set_up_edge_on_other_edges :
  fl v set_up_edge_on_other_bc_1 = rnd (of_1 b c * - s_ v) /\
  fl v set_up_edge_on_other_bc_y = rnd (of_y b c * - s_ v) /\
  fl v set_up_edge_on_other_bc_x = rnd (of_x b c * - s_ v) /\
  fl v set_up_edge_on_other_ca_1 = rnd (of_1 c a * - s_ v) /\
  fl v set_up_edge_on_other_ca_y = rnd (of_y c a * - s_ v) /\
  fl v set_up_edge_on_other_ca_x = rnd (of_x c a * - s_ v) /\
  fl v set_up_edge_on_other_ab_1 = rnd (of_1 a b * - s_ v) /\
  fl v set_up_edge_on_other_ab_y = rnd (of_y a b * - s_ v) /\
  fl v set_up_edge_on_other_ab_x = rnd (of_x a b * - s_ v) /\
  fl v set_up_edge_on_other_edge_error = e_max v.
Proof.
  assert (H := set_up_perspective_edges v). destruct other_is_minus as [E H'].
  assert (S : s_ v = 1 \/ s_ v = -1) by apply sign_cases.
  repeat match goal with H : _ /\ _ |- _ => destruct H end.
  repeat match goal with H : ?x = Mul _ _ |- _ => rewrite H; clear H end.
  cbn [value]. rewrite num_minus_1.
  repeat match goal with H : fl v _ = _ |- _ => rewrite H end.
  rewrite !times_minus_1 by exact S. repeat split; assumption.
Qed.

Theorem set_up_edge_on_sign :
  fl v set_up_edge_on_T = T_ v /\ fl v set_up_edge_on_T_error = t_max v /\
  (truth rnd v set_up_edge_on_sure = true <-> amount_ v > t_max v) /\
  (truth rnd v set_up_edge_on_other_sure = true <-> amount_ v > t_max v) /\
  (truth rnd v set_up_edge_on_parallel_sure = true <-> amount_ v > t_max v).
Proof.
  destruct (set_up_perspective_sign v) as [H1 [H2 H3]].
  split; [exact H1|]. split; [exact H2|]. split; [exact H3|]. split; exact H3.
Qed.

(** Nothing is said of how near it is: 0, off by infinity. *)
Theorem set_up_edge_on_nearness :
  set_up_edge_on_nearness_1 = Num 0 0 /\ set_up_edge_on_nearness_y = Num 0 0 /\
  set_up_edge_on_nearness_x = Num 0 0 /\ set_up_edge_on_nearness_error = Inf /\
  set_up_edge_on_other_nearness_1 = Num 0 0 /\ set_up_edge_on_other_nearness_y = Num 0 0 /\
  set_up_edge_on_other_nearness_x = Num 0 0 /\ set_up_edge_on_other_nearness_error = Inf /\
  set_up_edge_on_parallel_nearness_1 = Num 0 0 /\ set_up_edge_on_parallel_nearness_error = Inf.
Proof. repeat split. Qed.

End EdgeOn.

(** ** Which way the code goes *)

(** `terms`, of parallel rays times the depths, and whether they are too large, or NaN. *)
Definition rel (x p w : string) : expr := Sub (Var p) (Mul (Add (Var x) (Num 1 (-1))) (Var w)).
Definition size_tree : expr := Max (Max (Var "sa") (Var "sb")) (Var "sc").
Definition far_tree : expr :=
  Add (Max (Max (Max (Max (Max (Abs (rel "x0" "pa" "wa")) (Abs (rel "x0" "pb" "wb")))
    (Abs (rel "x0" "pc" "wc"))) (Abs (rel "y0" "qa" "wa"))) (Abs (rel "y0" "qb" "wb")))
    (Abs (rel "y0" "qc" "wc"))) (Add (Var "c0") (Mul (Var "c1") size_tree)).
Definition high_tree : expr :=
  Add (Max (Max (Abs (Var "wa")) (Abs (Var "wb"))) (Abs (Var "wc"))) (Mul (Var "weight") size_tree).
Definition terms_tree : expr :=
  Mul far_tree (Add (Mul (Mul (Num 1 2) (Var "reach")) high_tree) (Mul (Num 1 1) far_tree)).
Definition depths_tree : expr :=
  Max (Max (Max (Max (Max (Abs (Var "ta")) (Abs (Var "tb"))) (Abs (Var "tc")))
    (Abs (Sub (Var "tb") (Var "ta")))) (Abs (Sub (Var "tc") (Var "ta")))) (Num 1 0).
Definition huge : expr := Num 1 1000.
Definition lost : test := Not (Less terms_tree huge).
Definition lost_parallel : test := Not (Less (Mul terms_tree depths_tree) huge).

Lemma terms_value v : fl v terms_tree = terms_ v /\ fl v (Mul terms_tree depths_tree) = terms_parallel v.
Proof.
  split; cbv [terms_tree far_tree high_tree size_tree depths_tree rel]; cbn [value]; numbers; reflexivity.
Qed.

(** The ways that were recorded: nothing lost, T sure or not; and lost. *)
Definition sure_or_lost (l : test) : test :=
  Or (And l (Not (Same (Num 0 0) (Num 0 0)))) (And (Not l) set_up_perspective_sure).
Theorem set_up_paths :
  set_up_perspective_path = And (Not lost) (Not (Not set_up_perspective_sure)) /\
  set_up_edge_on_path = And (Not lost) (Not set_up_perspective_sure) /\
  set_up_lost_perspective_path = And lost (Not (sure_or_lost lost)) /\
  set_up_parallel_path = And (Not lost_parallel) (Not (Not set_up_perspective_sure)) /\
  set_up_edge_on_parallel_path = And (Not lost_parallel) (Not set_up_perspective_sure) /\
  set_up_lost_parallel_path = And lost_parallel (Not (sure_or_lost lost_parallel)).
Proof. repeat split. Qed.

(** In real numbers: what is not recorded as lost is below 2^1000. *)
Theorem not_lost v : (truth rnd v lost = false <-> terms_ v < bpow radix2 1000) /\
  (truth rnd v lost_parallel = false <-> terms_parallel v < bpow radix2 1000).
Proof.
  destruct (terms_value v) as [E1 E2]. unfold lost, lost_parallel. cbn [truth].
  rewrite E1, E2. cbn [value huge]. rewrite num_huge, !negb_false_iff, !true_less. tauto.
Qed.

(** ** Numbers are too large *)

Lemma recorded_lost :
  set_up_lost_perspective_bc_1 = Where lost (Num 0 0) set_up_perspective_bc_1 /\
  set_up_lost_perspective_edge_error = Where lost Inf set_up_perspective_edge_error /\
  set_up_lost_perspective_sure = sure_or_lost lost /\
  set_up_lost_parallel_bc_1 = Where lost_parallel (Num 0 0) set_up_perspective_bc_1 /\
  set_up_lost_parallel_edge_error = Where lost_parallel Inf set_up_perspective_edge_error /\
  set_up_lost_parallel_sure = sure_or_lost lost_parallel.
Proof. repeat split. Qed.

(** In binary64, as `terms` may well be infinite or NaN here: then the edges are 0 and their bound is
    infinite, and T is not sure. *)
Lemma when_lost (v : env) (l : test) e f : holds v l = true ->
  eval v (Where l (Num 0 0) e) = num 0 0 /\ eval v (Where l Inf f) = B754_infinity false /\
  holds v (sure_or_lost l) = false.
Proof.
  intros H. unfold sure_or_lost. cbn [eval holds]. rewrite H. split; [easy|]. split; [easy|].
  rewrite andb_false_l, orb_false_r, andb_true_l. change (num 0 0) with (B754_zero false : float). easy.
Qed.
Theorem set_up_lost_perspective_edges v : holds v lost = true ->
  eval v set_up_lost_perspective_bc_1 = num 0 0 /\
  eval v set_up_lost_perspective_edge_error = B754_infinity false.
Proof.
  intros H. destruct recorded_lost as [-> [-> _]].
  destruct (when_lost v lost set_up_perspective_bc_1 set_up_perspective_edge_error H) as [A [B _]].
  exact (conj A B).
Qed.
Theorem set_up_lost_perspective_sign v : holds v lost = true -> holds v set_up_lost_perspective_sure = false.
Proof.
  intros H. destruct recorded_lost as [_ [_ [-> _]]].
  destruct (when_lost v lost Inf Inf H) as [_ [_ A]]. exact A.
Qed.
Theorem set_up_lost_perspective_nearness :
  set_up_lost_perspective_nearness_1 = Num 0 0 /\ set_up_lost_perspective_nearness_error = Inf.
Proof. split; reflexivity. Qed.
Theorem set_up_lost_parallel_edges v : holds v lost_parallel = true ->
  eval v set_up_lost_parallel_bc_1 = num 0 0 /\
  eval v set_up_lost_parallel_edge_error = B754_infinity false.
Proof.
  intros H. destruct recorded_lost as [_ [_ [_ [-> [-> _]]]]].
  destruct (when_lost v lost_parallel set_up_perspective_bc_1 set_up_perspective_edge_error H) as [A [B _]].
  exact (conj A B).
Qed.
Theorem set_up_lost_parallel_sign v : holds v lost_parallel = true ->
  holds v set_up_lost_parallel_sure = false.
Proof.
  intros H. destruct recorded_lost as [_ [_ [_ [_ [_ ->]]]]].
  destruct (when_lost v lost_parallel Inf Inf H) as [_ [_ A]]. exact A.
Qed.
Theorem set_up_lost_parallel_nearness :
  set_up_lost_parallel_nearness_1 = Num 0 0 /\ set_up_lost_parallel_nearness_error = Inf.
Proof. split; reflexivity. Qed.
