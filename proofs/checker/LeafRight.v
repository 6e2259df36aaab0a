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
Notation b := (Leaf.together p).
Notation r := (Leaf.stored_ray p).
Notation start := (Leaf.start p).
Notation end_ := (Leaf.end_ p).
Notation unit := (bpow radix2 (shift_in b)).

(** What is given of the numbers: the ray's, the clip range's and the scene's are finite floats (of the
    clip range, the end may be infinity); each surface is what is stored of it, and names differ. One
    power of two is for all lengths, and one for all directions. Python's fractions are exact, and its
    division of integers rounds once. *)
Record given (scene : list surface) : Prop := {
  scene_stored : forall s, In s scene -> is_stored i s;
  different_names : forall s s', In s scene -> In s' scene -> called s = called s' -> s = s';
  end_not_nan : BinarySingleNaN.is_nan (Leaf.clip_end p) = false;
  end_not_minus : Leaf.clip_end p <> BinarySingleNaN.B754_infinity true;
  lengths_together : forall s, In s scene -> in_lengths b (reals (Leaf.origin p)) s;
  directions_together : in_directions i b;
  start_is : is_ratio unit (Finite start) (Leaf.start_ratio p);
  end_is : is_ratio unit end_ (Leaf.end_ratio p);
  scale_is : (0 < snd (Leaf.scale p))%Z /\ IZR (fst (Leaf.scale p)) / IZR (snd (Leaf.scale p)) = unit;
  division_rounds_once : true_division (Leaf.division p)
}.

(** ** What is computed, as [answers] of a contest in which all is left to integers *)

Definition asked {A} (s : surface) (f : Leaf.Met -> A) (other : A) : A :=
  match Leaf.exact_hit p s with Some h => f h | None => other end.
Definition compared (f : Leaf.Met -> Leaf.Met -> comparison) (s s' : surface) : comparison :=
  match Leaf.exact_hit p s, Leaf.exact_hit p s' with Some h, Some h' => f h h' | _, _ => Eq end.
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
  computed_t s := asked s (Leaf.t (Leaf.division p) (Leaf.scale p)) Infinity
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
Lemma unit_pos : 0 < unit.
Proof. apply bpow_gt_0. Qed.

(** The checker's hit is the tracer's. *)
Lemma exact_is_code s : In s scene ->
  Leaf.exact_hit p s = option_map (met_of (called s)) (code_hit i b s).
Proof.
  intros I. rewrite exact_hit_line. destruct (line_hit i b s) as [h|] eqn:H.
  - assert (L := lengths_together _ G s I). assert (St := scene_stored _ G s I).
    assert (C := code_hit_seen i b (directions_together _ G) end_known s L St h H).
    generalize (line_hit_right i b (directions_together _ G) s L St). rewrite H. intros [N Q].
    destruct (Z.eqb_spec (denominator_ h) 0) as [Z|Z].
    + destruct (code_hit i b s) as [h'|] eqn:E; [|reflexivity]. exfalso.
      assert (h' = h) by (apply code_hit_line in E; congruence). subst h'.
      destruct (proj1 C eq_refl) as [ND _]. now apply N in ND.
    + assert (ND := proj1 N Z). destruct (Q ND) as [T _].
      assert (K := clipped_right unit start end_ _ _ unit_pos (start_is _ G) (end_is _ G) end_known
        (Leaf.top (met_of (called s) h)) _ (bottom_above (called s) h Z)).
      rewrite ratio_met in K by exact Z. fold (t_exact (shift_in b) h) in K. rewrite T in K.
      cbv zeta. destruct (Leaf.clipped _ _ _ _) eqn:E.
      * destruct (code_hit i b s) as [h'|] eqn:F; [|reflexivity]. exfalso.
        assert (h' = h) by (apply code_hit_line in F; congruence). subst h'.
        destruct (proj1 C eq_refl) as [_ R]. apply K in R. discriminate.
      * rewrite (proj2 C); [reflexivity|]. split; [exact ND | now apply K].
  - destruct (code_hit i b s) as [h|] eqn:E; [|reflexivity]. apply code_hit_line in E. congruence.
Qed.
Lemma line_is_hit s h : line_hit i b s = Some h -> is_hit h.
Proof.
  unfold line_hit, is_hit. destruct (shape_of s) as [x|q n].
  - unfold Integers.hit, _triangle. match goal with |- (if ?c then _ else _) = _ -> _ => destruct c eqn:E end;
      [discriminate|]. intros [= <-]. cbn [edges sides spans denominator_]. right. repeat eexists.
    cbn [map min_ max_ fold_right] in E. rewrite andb_false_iff, !Z.ltb_ge in E. lia.
  - intros [= <-]. now left.
Qed.
Lemma hit_of s : In s scene -> ((exists m, Leaf.exact_hit p s = Some m) <-> met s).
Proof.
  intros I. rewrite (exact_is_code s I).
  assert (C := code_hit_met i b (directions_together _ G) end_known s (lengths_together _ G s I)
    (scene_stored _ G s I)).
  unfold Facts.met. split.
  - intros [m M]. destruct (code_hit i b s) as [h|]; [|discriminate]. split; [exact I|]. apply C. eauto.
  - intros [_ M]. apply C in M. destruct M as [h ->]. eexists. reflexivity.
Qed.
Lemma met_hit s : met s -> exists h, code_hit i b s = Some h /\
  Leaf.exact_hit p s = Some (met_of (called s) h) /\ denominator_ h <> 0%Z /\ is_hit h /\
  ratio h * unit = t r s /\ (Hits.on_edge h = false <-> meets_within r s).
Proof.
  intros M. assert (I := proj1 M). assert (K := proj2 (hit_of s I) M). rewrite (exact_is_code s I) in *.
  destruct (code_hit i b s) as [h|] eqn:H; [|destruct K as [m K]; discriminate].
  destruct (code_hit_facts i b (directions_together _ G) end_known s (lengths_together _ G s I)
    (scene_stored _ G s I) h H) as (N & T & E).
  exists h. repeat (split; auto). eapply line_is_hit, code_hit_line, H.
Qed.
Lemma on_edge_met n h : Leaf.on_edge (met_of n h) = Hits.on_edge h.
Proof. unfold Leaf.on_edge. now destruct (met_of_turned n h) as (_ & _ & _ & _ & -> & _). Qed.

(** t is rounded once. *)
Lemma t_right s h : code_hit i b s = Some h -> denominator_ h <> 0%Z -> ratio h * unit = t r s ->
  Leaf.t (Leaf.division p) (Leaf.scale p) (met_of (called s) h) = nearest_float (t r s).
Proof.
  intros _ N T. set (m := met_of (called s) h).
  assert (B : (0 < Leaf.bottom m)%Z) by now apply bottom_above.
  assert (Q : IZR (Leaf.top m) / IZR (Leaf.bottom m) = ratio h) by now apply ratio_met.
  destruct (scale_is _ G) as [D S]. unfold Leaf.t. rewrite (division_rounds_once _ G) by nia.
  assert (B' := IZR_lt _ _ B). assert (D' := IZR_lt _ _ D).
  assert (E : IZR (Leaf.top m * fst (Leaf.scale p)) / IZR (Leaf.bottom m * snd (Leaf.scale p)) = t r s).
  { rewrite !mult_IZR, <- T, <- Q, <- S. field. lra. }
  rewrite E. unfold nearest_float. case Rlt_bool_spec; intros L; [reflexivity|].
  assert (NZ : t r s <> 0).
  { intros Z. rewrite Z in L. unfold rnd in L. rewrite round_0 in L by apply valid_rnd_N.
    rewrite Rabs_R0 in L. generalize (bpow_gt_0 radix2 emax). lra. }
  assert (P : t r s = IZR (Leaf.top m) * (unit / IZR (Leaf.bottom m))).
  { rewrite <- T, <- Q. field. lra. }
  assert (U : 0 < unit / IZR (Leaf.bottom m)) by (apply Rdiv_lt_0_compat; [apply unit_pos | exact B']).
  destruct (Z.ltb_spec 0 (Leaf.top m)) as [K|K]; case Rlt_bool_spec; intros H; try reflexivity; exfalso.
  - apply IZR_lt in K. nra.
  - apply IZR_le in K. nra.
Qed.

(** The facts that the theorem of contests asks for. *)
Lemma compare_right s s' h h' : code_hit i b s = Some h -> code_hit i b s' = Some h' ->
  denominator_ h <> 0%Z -> denominator_ h' <> 0%Z ->
  ratio h * unit = t r s -> ratio h' * unit = t r s' ->
  Leaf.compare_at (met_of (called s) h) (met_of (called s') h') = Rcompare (t r s) (t r s').
Proof.
  intros _ _ N N' <- <-. unfold Leaf.compare_at.
  rewrite <- (ratio_met (called s) h N), <- (ratio_met (called s') h' N').
  assert (B := bottom_above (called s) h N). assert (B' := bottom_above (called s') h' N').
  set (T1 := Leaf.top _) in *. set (T2 := Leaf.top (met_of (called s') h')) in *.
  set (D1 := Leaf.bottom _) in *. set (D2 := Leaf.bottom (met_of (called s') h')) in *.
  assert (Le := fraction_le unit unit_pos T1 D1 T2 D2 B B').
  assert (Ge := fraction_le unit unit_pos T2 D2 T1 D1 B' B).
  set (x := IZR T1 / IZR D1 * unit) in *. set (y := IZR T2 / IZR D2 * unit) in *.
  case Rcompare_spec; intros C; destruct (Z.compare_spec (T1 * D2) (T2 * D1)) as [K|K|K]; try reflexivity;
    exfalso.
  - assert (T2 * D1 <= T1 * D2)%Z as H by lia. apply Ge in H. lra.
  - assert (T2 * D1 <= T1 * D2)%Z as H by lia. apply Ge in H. lra.
  - assert (~ (T2 * D1 <= T1 * D2)%Z) as H by lia. apply H, Ge. lra.
  - assert (~ (T1 * D2 <= T2 * D1)%Z) as H by lia. apply H, Le. lra.
  - assert (T1 * D2 <= T2 * D1)%Z as H by lia. apply Le in H. lra.
  - assert (T1 * D2 <= T2 * D1)%Z as H by lia. apply Le in H. lra.
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
  - intros s M. simpl. unfold asked. destruct (met_hit s M) as (h & _ & -> & _ & _ & _ & E).
    now rewrite on_edge_met.
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
    unfold Leaf.AXES. rewrite is_crossed_right by assumption. assert (I := proj1 M).
    apply (code_is_crossed_right i b (directions_together _ G) end_known s h
      (lengths_together _ G s I) (scene_stored _ G s I) H).
  - intros s s' M M'. simpl. unfold compared.
    destruct (met_hit s M) as (h & H & -> & N & _). destruct (met_hit s' M') as (h' & H' & -> & N' & _).
    assert (I := proj1 M). assert (I' := proj1 M').
    assert (E : forall z, Z.compare z 0 = Z.compare (Z.sgn z) 0) by (intros []; reflexivity).
    rewrite E. unfold Leaf.AXES. rewrite order_right by assumption.
    refine (weaker _ soon_filter _ _ _ (code_sign_right i b (directions_together _ G) end_known s s' h h'
      (lengths_together _ G s I) (lengths_together _ G s' I') (scene_stored _ G s I) (scene_stored _ G s' I')
      H H')).
    intros by_ K _ _. exact K.
Qed.
End Given.
End Pixel.
