(** ladder.py: what becomes of a pair once its interval is known, as recorded, is what the model says.

    [in_range] has two records, for a start that is negative and one that is not; [_candidates] was
    recorded with a start that is not negative, of one pair that is sure, and of one that is not. *)
Require Import ZArith Reals Psatz List String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Trees RecordedBounds RecordedDecisions RecordedChoices Pairs.
From Reftrace Require Contest CodeFloats.
From Reftrace Require Import CodeAnswers.
Import ListNotations.
Open Scope R_scope.
Open Scope string_scope.

(** Comparisons of floats that are not NaN are those of numbers. *)
Lemma less_number (x y : float) : is_nan x = false -> is_nan y = false ->
  match Bcompare x y with Some Datatypes.Lt => true | _ => false end =
  Contest.less (number_of x) (number_of y).
Proof.
  intros X Y. destruct (is_finite x) eqn:Fx, (is_finite y) eqn:Fy.
  - rewrite (Bcompare_correct prec emax) by assumption.
    rewrite !CodeFloats.number_of_finite by assumption. reflexivity.
  - rewrite (CodeFloats.number_of_finite x) by assumption.
    destruct x as [|[]| |[]], y as [|[]| |]; try discriminate; reflexivity.
  - rewrite (CodeFloats.number_of_finite y) by assumption.
    destruct x as [|[]| |], y as [|[]| |[]]; try discriminate; reflexivity.
  - destruct x as [|[]| |], y as [|[]| |]; try discriminate; reflexivity.
Qed.
Lemma less_eq_number (x y : float) : is_nan x = false -> is_nan y = false ->
  match Bcompare x y with Some Datatypes.Lt | Some Datatypes.Eq => true | _ => false end =
  Contest.less_eq (number_of x) (number_of y).
Proof.
  intros X Y. unfold Contest.less_eq. rewrite <- less_number by assumption.
  rewrite (Bcompare_swap _ _ y x). destruct (Bcompare y x) as [[]|] eqn:C; try reflexivity.
  exfalso. revert C. destruct x as [[]|[]| |[]], y as [[]|[]| |[]]; try discriminate.
Qed.
Lemma min_number (x y : float) : is_nan x = false -> is_nan y = false ->
  number_of (fmin x y) = Contest.least (number_of x) (number_of y) /\ is_nan (fmin x y) = false.
Proof.
  intros X Y. unfold Contest.least. rewrite <- less_number by assumption. unfold fmin.
  rewrite (Bcompare_swap _ _ y x). destruct (Bcompare y x) as [[]|] eqn:C; try (split; auto; reflexivity).
  exfalso. revert C. destruct x as [[]|[]| |[]], y as [[]|[]| |[]]; try discriminate.
Qed.

Section Range.
Variable i : inputs.
Hypothesis origin_finite : finite (ray_origin i).
Hypothesis direction_finite : finite (ray_direction i).
Hypothesis one_of : one_of_the_rays i.
Hypothesis start_finite : is_finite (clip_start i) = true.
Hypothesis end_not_nan : is_nan (clip_end i) = false.
Variable s : Contest.surface.
Hypothesis stored : is_stored i s.
Notation a := (code_answers i).

Variable farthest : float.
Hypothesis farthest_not_nan : is_nan farthest = false.
Definition range_env : env :=
  Env (named "low" (low_float i s) (named "high" (high_float i s) (named "start" (clip_start i)
    (named "end" (clip_end i) (named "farthest" farthest nothing))))) (fun _ => code_sure i s).
Notation v := range_env.

Lemma low_not_nan : is_nan (low_float i s) = false.
Proof. now apply CodeFloats.ends_are_numbers. Qed.
Lemma high_not_nan : is_nan (high_float i s) = false.
Proof. now apply CodeFloats.ends_are_numbers. Qed.
Lemma start_not_nan : is_nan (clip_start i) = false.
Proof. revert start_finite. now destruct (clip_start i). Qed.
Lemma start_number : number_of (clip_start i) = Contest.Finite (start i).
Proof. now apply CodeFloats.number_of_finite. Qed.
Hint Resolve low_not_nan high_not_nan start_not_nan : core.

Lemma less_tree x y : is_nan (eval v x) = false -> is_nan (eval v y) = false ->
  holds v (Less x y) = Contest.less (number_of (eval v x)) (number_of (eval v y)).
Proof. apply less_number. Qed.
Lemma outside_tree : holds v (Or (Less (Var "high") (Var "start")) (Less (Var "end") (Var "low"))) =
  Contest.less (number_of (high_float i s)) (Contest.Finite (start i)) ||
  Contest.less (end_ i) (number_of (low_float i s)).
Proof.
  rewrite <- start_number. cbn [holds]. f_equal; apply less_number; auto.
Qed.
Definition doubt_tree := Where (And (Given "sure") (Trees.Finite (Var "high"))) (Where (And (Less (Var
  "start") (Var "low"))
    (Less (Var "high") (Var "end"))) (Num 0 0) (Num 1 1)) (Num 1 0).
Lemma doubt_is : holds v (Same doubt_tree (Num 0 0)) = Contest.SURE a (start i) (end_ i) s.
Proof.
  unfold Contest.SURE, Contest.in_range, Contest.high. cbn [code_answers Contest.sure Contest.interval_high
    Contest.interval_low].
  rewrite CodeFloats.finite_number_of, <- start_number.
  assert (E : holds v (And (Less (Var "start") (Var "low")) (Less (Var "high") (Var "end"))) =
    Contest.less (number_of (clip_start i)) (number_of (low_float i s)) &&
    Contest.less (number_of (high_float i s)) (end_ i)).
  { cbn [holds]. f_equal; apply less_number; auto. }
  rewrite <- E. unfold doubt_tree.
  change (holds v (Same ?w (Num 0 0))) with (match Bcompare (eval v w) (num 0 0) with Some Datatypes.Eq =>
    true | _ => false end).
  cbn [eval]. change (holds v (And (Given "sure") (Trees.Finite (Var "high")))) with (code_sure i s &&
    is_finite (high_float i s)).
  destruct (code_sure i s && is_finite (high_float i s)); [|reflexivity].
  now destruct (holds v (And _ _)).
Qed.

(** ** [in_range] *)

Theorem path_is : holds v in_range_behind_path = Contest.behind (start i) /\
  holds v in_range_path = negb (Contest.behind (start i)).
Proof.
  assert (E : holds v (Less (Var "start") (Num 0 0)) = Contest.behind (start i)).
  { rewrite less_tree by (auto || reflexivity). unfold Contest.behind.
    change (eval v (Var "start")) with (clip_start i). rewrite start_number. reflexivity. }
  unfold in_range_behind_path, in_range_path. cbn [holds] in *. rewrite E. auto.
Qed.

Theorem in_range_is : holds v in_range_path = true ->
  number_of (eval v in_range_low) = Contest.low a (start i) s /\
  number_of (eval v in_range_high) = Contest.high a s /\
  holds v in_range_outside = Contest.outside a (start i) (end_ i) s /\
  holds v (Same in_range_doubt (Num 0 0)) = Contest.SURE a (start i) (end_ i) s.
Proof.
  rewrite (proj2 path_is), negb_true_iff. intros B. unfold Contest.low, Contest.outside. rewrite B.
  repeat split; [|exact doubt_is]. rewrite andb_true_r. exact outside_tree.
Qed.

Theorem in_range_behind_is : holds v in_range_behind_path = true ->
  number_of (eval v in_range_behind_low) = Contest.low a (start i) s /\
  number_of (eval v in_range_behind_high) = Contest.high a s /\
  holds v in_range_behind_outside = Contest.outside a (start i) (end_ i) s /\
  holds v (Same in_range_behind_doubt (Num 0 0)) = Contest.SURE a (start i) (end_ i) s.
Proof.
  rewrite (proj1 path_is). intros B. unfold Contest.low, Contest.outside. rewrite B.
  cbn [code_answers Contest.interval_low]. unfold Contest.high. cbn [code_answers Contest.interval_high].
  rewrite CodeFloats.finite_number_of.
  repeat split; [| |exact doubt_is].
  - unfold in_range_behind_low. cbn [eval]. change (holds v (Trees.Finite (Var "high"))) with (is_finite
    (high_float i s)).
    now destruct (is_finite (high_float i s)).
  - unfold in_range_behind_outside. etransitivity; [|apply (f_equal (fun x => x && _) outside_tree)].
    reflexivity.
Qed.

(** ** [_candidates]: a batch of this pair alone *)

Definition entered (certain kept : test) (far : expr) (k : list Contest.surface) (c : Contest.contest) :
  Prop :=
  c = Contest.Contest (number_of (eval v far)) (k ++ if holds v kept then [s] else []).

Theorem candidates_is k : Contest.possible a s = true -> holds v in_range_path = true ->
  let c := Contest.enter a (start i) (end_ i) (Contest.Contest (number_of farthest) k) [s] in
  if holds v candidate_sure_certain
  then entered candidate_sure_certain candidate_sure_kept candidate_sure_farthest k c
  else entered candidate_open_certain candidate_open_kept candidate_open_farthest k c.
Proof.
  intros P H. assert (R := in_range_is H). destruct R as [L [Hi [O _]]].
  change (holds v candidate_sure_certain) with (holds v (Same doubt_tree (Num 0 0))). rewrite doubt_is.
  unfold Contest.enter. cbn [filter Contest.farthest Contest.kept]. rewrite P.
  unfold Contest.nearest_sure. cbn [fold_left].
  assert (Kept : forall far, is_nan (eval v far) = false ->
    holds v (And (Not in_range_outside) (LessEq (Var "low") far)) =
    negb (Contest.outside a (start i) (end_ i) s) && Contest.less_eq (Contest.low a (start i) s) (number_of
      (eval v far))).
  { intros far F. cbn [holds]. rewrite O, <- L. f_equal. apply less_eq_number; auto. }
  destruct (Contest.SURE a (start i) (end_ i) s); unfold entered.
  - destruct (min_number farthest (high_float i s) farthest_not_nan high_not_nan) as [M N].
    change (holds v candidate_sure_kept) with
      (holds v (And (Not in_range_outside) (LessEq (Var "low") candidate_sure_farthest))).
    change (eval v candidate_sure_farthest) with (fmin farthest (high_float i s)).
    rewrite Kept by exact N. change (eval v candidate_sure_farthest) with (fmin farthest (high_float i s)).
    rewrite M. unfold Contest.high. cbn [code_answers Contest.interval_high]. reflexivity.
  - change (holds v candidate_open_kept) with
      (holds v (And (Not in_range_outside) (LessEq (Var "low") candidate_open_farthest))).
    rewrite Kept by exact farthest_not_nan. reflexivity.
Qed.
End Range.

(** measures.py: t by quotient.py is taken where that is sure, and t finite: [CertifiedDepth.recorded_quotient]. *)
Theorem taken_is_finite v : holds v taken_as_it_is = true ->
  holds v (Given "sure") = true /\ is_finite (eval v (Var "t")) = true.
Proof. unfold taken_as_it_is. cbn. rewrite !andb_true_iff. tauto. Qed.
