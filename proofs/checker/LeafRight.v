(** The facts that the theorem of contests (Nearby.v) asks for hold of the answers of the checker. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Flocq Require BinarySingleNaN.
From Reftrace Require Import Geometry Trees Integers Clip.
From Reftrace Require Import Contest Facts Nearby.
From Reftrace Require Ties Hits Nearest Settle.
From Reftrace Require Import CodeAnswers CodeIntegers CodeRule.
From Reftrace Require Leaf CodeFloats.
From Reftrace Require Import LeafHits.
Import ListNotations.
Open Scope R_scope.

Section Pixel.
Variable p : Leaf.pixel.
Notation i := (as_inputs p).
Notation b := (in_one p).
Notation r := (Leaf.stored_ray p).
Notation start := (Leaf.start p).
Notation end_ := (Leaf.end_ p).

(** What is given of the numbers: those of the ray, the clip range and the scene are finite floats (the
    clip range may end at infinity, and is not empty); each surface is what is stored of it, and names
    differ; none is the file's name for nothing. All numbers have one power of two. Python's fractions are
    exact, and its division of integers rounds once. *)
Definition all_of (s : surface) : list R :=
  lengths_of s ++ match shape_of s with Infinite _ n => components n | _ => [] end.
Record given (scene : list surface) : Prop := {
  scene_stored : forall s, In s scene -> is_stored i s;
  different_names : forall s s', In s scene -> In s' scene -> called s = called s' -> s = s';
  not_nowhere : forall s, In s scene -> called s <> Leaf.NOWHERE;
  end_not_nan : BinarySingleNaN.is_nan (Leaf.clip_end p) = false;
  end_not_minus : Leaf.clip_end p <> BinarySingleNaN.B754_infinity true;
  range_not_empty : less (Finite start) end_ = true;
  ray_together : incl (components (reals (Leaf.origin p)) ++ components (reals (Leaf.direction p)))
    (Leaf.together p);
  all_together : forall s, In s scene -> incl (all_of s) (Leaf.together p);
  start_is : is_ratio (Finite start) (Leaf.start_ratio p);
  end_is : is_ratio end_ (Leaf.end_ratio p);
  division_rounds_once : true_division (Leaf.division p)
}.

(** ** What is computed, as [answers] of a contest in which all is left to integers *)

Definition asked {A} (s : surface) (f : Leaf.Met -> A) (other : A) : A :=
  match Leaf.exact_hit p s with Some h => f h | None => other end.
Definition compared (f : Leaf.Met -> Leaf.Met -> comparison) (s s' : surface) : comparison :=
  match Leaf.exact_hit p s, Leaf.exact_hit p s' with Some h, Some h' => f h h' | _, _ => Eq end.
(** t, if that were infinite where Python has no float for it. *)
Definition t_of (h : Leaf.Met) : number :=
  match Leaf.division p (Leaf.top h) (Leaf.bottom h) with
  | Some t => Finite t
  | None => if Bool.eqb (0 <? Leaf.top h)%Z (0 <? Leaf.bottom h)%Z then Infinity else MinusInfinity
  end.
Definition by_leaf : answers := {|
  possible _ := true;
  sure _ := false;
  interval_low _ := MinusInfinity;
  interval_high _ := Infinity;
  order_applies := false;
  order_of _ _ := UNDECIDED;
  two_by_two := false;
  hit s := asked s (fun _ => true) false;
  on_edge s := asked s Leaf.on_edge false;
  is_crossed s := asked s (Leaf.is_crossed Leaf.AXES) false;
  gap := compared Leaf.compare_at;
  sign_of_difference := compared (fun h h' => Z.compare (Leaf.order Leaf.AXES h h') 0);
  computed_t s := asked s t_of Infinity
|}.

Section Given.
Context {scene : list surface}.
Hypothesis G : given scene.
Notation met := (met r start end_ scene).

Lemma end_known : end_ <> MinusInfinity.
Proof.
  generalize (end_not_nan _ G) (end_not_minus _ G). unfold Leaf.end_.
  destruct (Leaf.clip_end p) as [|[]| |]; simpl; intros; congruence.
Qed.
Lemma lengths_together s : In s scene -> in_lengths b (reals (Leaf.origin p)) s.
Proof.
  intros I x X. apply in_app_or in X. destruct X as [X|X].
  - apply (ray_together _ G), in_or_app. now left.
  - apply (all_together _ G s I), in_or_app. now left.
Qed.
Lemma directions_together : in_directions i b.
Proof. intros x X. apply (ray_together _ G), in_or_app. now right. Qed.
Lemma not_scaled h : t_exact (shift_in b) h = ratio h.
Proof.
  unfold t_exact, shift_in, shift, in_one, unit_in. cbn [lengths directions]. rewrite Z.sub_diag.
  apply Rmult_1_r.
Qed.

(** The checker's hit is the tracer's. *)
Lemma exact_is_code s : In s scene ->
  Leaf.exact_hit p s = option_map (met_of (by_of p s) (called s)) (code_hit i b s).
Proof.
  intros I. rewrite exact_hit_line.
  2: { apply (LeafHits.range_not_empty start end_); apply G. }
  2: { assert (A := all_together _ G s I). unfold all_of in A. destruct (shape_of s); [constructor|].
    intros x X. apply A, in_or_app. now right. } destruct (line_hit i b s) as [h|] eqn:H.
  - assert (L := lengths_together s I). assert (St := scene_stored _ G s I).
    assert (C := code_hit_seen i b directions_together end_known s L St h H).
    generalize (line_hit_right i b directions_together s L St). rewrite H. intros [N Q].
    destruct (Z.eqb_spec (denominator_ h) 0) as [Z|Z].
    + destruct (code_hit i b s) as [h'|] eqn:E; [|reflexivity]. exfalso.
      assert (h' = h) by (apply code_hit_line in E; congruence). subst h'.
      destruct (proj1 C eq_refl) as [ND _]. now apply N in ND.
    + assert (ND := proj1 N Z). destruct (Q ND) as [T _].
      assert (K := in_ends_right start end_ _ _ (start_is _ G) (end_is _ G) (range_not_empty _ G)
        (Leaf.top (met_of (by_of p s) (called s) h)) _ (bottom_not_0 _ (called s) h (by_pos p s) Z)).
      rewrite ratio_met, <- not_scaled, T in K by (exact Z || apply by_pos).
      cbv zeta. destruct (in_ends _ _ _ _) eqn:E.
      * rewrite (proj2 C); [reflexivity|]. split; [exact ND | now apply K].
      * destruct (code_hit i b s) as [h'|] eqn:F; [|reflexivity]. exfalso.
        assert (h' = h) by (apply code_hit_line in F; congruence). subst h'.
        destruct (proj1 C eq_refl) as [_ R]. apply K in R. discriminate.
  - destruct (code_hit i b s) as [h|] eqn:E; [|reflexivity]. apply code_hit_line in E. congruence.
Qed.
Lemma line_is_hit s h : line_hit i b s = Some h -> is_hit h.
Proof.
  unfold line_hit, is_hit. destruct (shape_of s) as [x|q n].
  - generalize (direction_in i b) (origin_in i b) (integers_of (lengths b) (ca x))
      (integers_of (lengths b) (cb x)) (integers_of (lengths b) (cc x)). intros d o A B C.
    unfold Integers.hit, _triangle. match goal with |- (if ?c then _ else _) = _ -> _ => destruct c eqn:E end;
      [discriminate|]. intros [= <-]. cbn [edges sides spans denominator_]. right. repeat eexists.
    cbn [map min_ max_ fold_right] in E. rewrite andb_false_iff, !Z.ltb_ge in E. lia.
  - intros [= <-]. now left.
Qed.
Lemma hit_of s : In s scene -> ((exists m, Leaf.exact_hit p s = Some m) <-> met s).
Proof.
  intros I. rewrite (exact_is_code s I).
  assert (C := code_hit_met i b directions_together end_known s (lengths_together s I)
    (scene_stored _ G s I)).
  unfold Facts.met. split.
  - intros [m M]. destruct (code_hit i b s) as [h|]; [|discriminate]. split; [exact I|]. apply C. eauto.
  - intros [_ M]. apply C in M. destruct M as [h ->]. eexists. reflexivity.
Qed.
Lemma met_hit s : met s -> exists h, code_hit i b s = Some h /\
  Leaf.exact_hit p s = Some (met_of (by_of p s) (called s) h) /\ denominator_ h <> 0%Z /\ is_hit h /\
  ratio h = t r s /\ (Hits.on_edge h = false <-> meets_within r s).
Proof.
  intros M. assert (I := proj1 M). assert (K := proj2 (hit_of s I) M). rewrite (exact_is_code s I) in *.
  destruct (code_hit i b s) as [h|] eqn:H; [|destruct K as [m K]; discriminate].
  destruct (code_hit_facts i b directions_together end_known s (lengths_together s I)
    (scene_stored _ G s I) h H) as (N & T & E). rewrite not_scaled in T.
  exists h. repeat (split; auto). eapply line_is_hit, code_hit_line, H.
Qed.
(** t is rounded once. *)
Lemma t_right s h : denominator_ h <> 0%Z -> ratio h = t r s ->
  t_of (met_of (by_of p s) (called s) h) = nearest_float (t r s).
Proof.
  intros N T. set (m := met_of (by_of p s) (called s) h).
  assert (B : Leaf.bottom m <> 0%Z) by (apply bottom_not_0; [apply by_pos | exact N]).
  assert (Q : IZR (Leaf.top m) / IZR (Leaf.bottom m) = t r s)
    by (rewrite <- T; apply ratio_met; [apply by_pos | exact N]).
  unfold t_of. rewrite (division_rounds_once _ G) by exact B. rewrite Q.
  unfold nearest_float. case Rlt_bool_spec; intros L; [reflexivity|].
  assert (NZ : t r s <> 0).
  { intros Z. rewrite Z in L. unfold rnd in L. rewrite round_0 in L by apply valid_rnd_N.
    rewrite Rabs_R0 in L. generalize (bpow_gt_0 radix2 emax). lra. }
  assert (P : t r s * IZR (Leaf.bottom m) = IZR (Leaf.top m)).
  { rewrite <- Q. field. now apply not_0_IZR. }
  destruct (Z.ltb_spec 0 (Leaf.top m)) as [K|K], (Z.ltb_spec 0 (Leaf.bottom m)) as [J|J]; simpl Bool.eqb;
    cbv iota; case Rlt_bool_spec; intros H; try reflexivity; exfalso; apply IZR_lt in K || apply IZR_le in K;
    (apply IZR_lt in J || (assert (J' : (Leaf.bottom m < 0)%Z) by lia; apply IZR_lt in J')); nra.
Qed.

(** The facts that the theorem of contests asks for. *)
Lemma compare_right s s' h h' : denominator_ h <> 0%Z -> denominator_ h' <> 0%Z ->
  ratio h = t r s -> ratio h' = t r s' ->
  Leaf.compare_at (met_of (by_of p s) (called s) h) (met_of (by_of p s') (called s') h') =
  Rcompare (t r s) (t r s').
Proof.
  intros N N' <- <-. unfold Leaf.compare_at.
  rewrite compare_ratios_right by (apply bottom_not_0; [apply by_pos | assumption]).
  now rewrite !ratio_met by (assumption || apply by_pos).
Qed.

Lemma leaf_ray_facts batches : (forall s, met s -> In s (concat batches)) ->
  NoDup (concat batches) -> incl (concat batches) scene ->
  ray_facts r start end_ scene batches by_leaf.
Proof.
  intros All Once Some_. constructor; simpl; auto; try easy.
  - exact (different_names _ G).
  - assert (E := end_known). unfold Leaf.end_ in *.
    destruct (number_of (Leaf.clip_end p)) as [|e|] eqn:H; auto.
    apply CodeFloats.number_of_float in H. destruct H as [F <-]. now exists (Leaf.clip_end p).
  - intros s I. simpl. unfold asked. rewrite <- (hit_of s I).
    destruct (Leaf.exact_hit p s) as [h|]; split; eauto; try discriminate. now intros [h H].
  - intros s M. simpl. unfold asked. destruct (met_hit s M) as (h & _ & -> & _ & Q & _ & E).
    unfold Leaf.on_edge. now rewrite values_met.
  - intros s s' M M'. simpl. unfold compared.
    destruct (met_hit s M) as (h & H & -> & N & _ & T & _).
    destruct (met_hit s' M') as (h' & H' & -> & N' & _ & T' & _). now apply compare_right.
  - intros s M. simpl. unfold asked. destruct (met_hit s M) as (h & H & -> & N & _ & T & _).
    now apply t_right.
Qed.
Lemma leaf_rule_facts : @rule_facts_nearby _ soon (moved_ray r) r start end_ scene by_leaf.
Proof.
  constructor.
  - intros s M. simpl. unfold asked. destruct (met_hit s M) as (h & H & -> & N & Q & _).
    unfold Leaf.AXES. rewrite is_crossed_right by (assumption || apply by_pos). assert (I := proj1 M).
    apply (code_is_crossed_right i b directions_together end_known s h
      (lengths_together s I) (scene_stored _ G s I) H).
  - intros s s' M M'. simpl. unfold compared.
    destruct (met_hit s M) as (h & H & -> & N & _). destruct (met_hit s' M') as (h' & H' & -> & N' & _).
    assert (I := proj1 M). assert (I' := proj1 M').
    assert (E : forall z, Z.compare z 0 = Z.compare (Z.sgn z) 0) by (intros []; reflexivity).
    rewrite E. unfold Leaf.AXES. rewrite order_right by (assumption || apply by_pos).
    refine (weaker _ soon_filter _ _ _ (code_sign_right i b directions_together end_known s s' h h'
      (lengths_together s I) (lengths_together s' I') (scene_stored _ G s I) (scene_stored _ G s' I')
      H H')).
    intros by_ K _ _. exact K.
Qed.
End Given.
End Pixel.
