(** What [code_answers] says in integers of one surface or two: hit, on an edge, the order, t. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Flocq Require BinarySingleNaN.
From Reftrace Require Import Geometry Trees Magnitude Integers Clip.
From Reftrace Require Contest Facts Nearest.
From Reftrace Require Hits.
From Reftrace Require Import CodeAnswers.
Import ListNotations.
Open Scope R_scope.

(** ** Integers.v's hit of a triangle, by its edges *)

Definition one_sided (x y z : R) : Prop := (0 <= x /\ 0 <= y /\ 0 <= z) \/ (x <= 0 /\ y <= 0 /\ z <= 0).

Lemma hit_by_edges d o a b c :
  let r := real_ray o d in
  let sided := one_sided (edge r (real a) (real b)) (edge r (real b) (real c)) (edge r (real c) (real a)) in
  match hit d o a b c with None => ~ sided | Some h => sided end.
Proof.
  cbv zeta. destruct (hit d o a b c) as [h|] eqn:H.
  - assert (G := hit_is_geometry _ _ _ _ _ _ H). cbv zeta in G. destruct G as (_ & _ & _ & _ & G).
    revert H. unfold hit. destruct (_triangle o a b c) as [[[n m] si] sp] eqn:E.
    unfold _triangle in E. injection E as <- <- <- <-.
    match goal with |- (if ?c then _ else _) = _ -> _ => destruct c eqn:C end; [discriminate|].
    intros [= <-]. cbn [edges map] in G. injection G as <- <- <-.
    cbn [map min_ max_ fold_right] in C. rewrite andb_false_iff, !Z.ltb_ge in C.
    unfold one_sided. destruct C as [C|C]; [left | right]; repeat split; apply IZR_le; lia.
  - apply hit_none in H. cbn [_triangle snd fst map min_ max_ fold_right] in H.
    rewrite !edge_other. unfold real_ray. cbn [origin direction].
    rewrite <- !real_sub, <- !real_cross, <- !real_dot. unfold one_sided.
    intros [[A [B C]]|[A [B C]]]; apply le_IZR in A, B, C; lia.
Qed.

Section Batch.
Variable i : inputs.
Notation r := (stored_ray i).
Variable b : batch.
Notation o := (origin_in i b).
Notation d := (direction_in i b).
Notation unit := (unit_in b).
Notation direction_unit := (exponent_of (directions b)).
Notation int := (integers_of (lengths b)).

Lemma vector_exact xs v : incl (components v) xs ->
  is_float (vx v) -> is_float (vy v) -> is_float (vz v) -> v = scaled (exponent_of xs) (integers_of xs v).
Proof.
  intros I X Y Z. destruct v as [x y z]. apply vscale_exact; auto; apply I; simpl; auto.
Qed.
Lemma stored_exact xs (v : floats) : incl (components (reals v)) xs ->
  reals v = scaled (exponent_of xs) (integers_of xs (reals v)).
Proof. intros I. apply vector_exact; auto; apply B2R_is_float. Qed.

Hypothesis directions_in : in_directions i b.
Hypothesis end_is : number_of (clip_end i) <> Contest.MinusInfinity.

Lemma ray_exact s : in_lengths b (reals (ray_origin i)) s -> r = float_ray unit direction_unit o d.
Proof.
  intros I. unfold stored_ray, float_ray, origin_in, direction_in, unit_in. f_equal; apply stored_exact; auto.
  intros x X. apply I, in_or_app. now left.
Qed.
Section Stored.
Variable s : Contest.surface.
Hypothesis surface_in : incl (lengths_of s) (lengths b).
Hypothesis stored : is_stored i s.

Lemma stored_triangle x : Contest.shape_of s = Contest.Triangular x ->
  x = float_triangle unit (int (ca x)) (int (cb x)) (int (cc x)).
Proof.
  intros S. assert (I := surface_in).
  unfold lengths_of in I. rewrite S in I. destruct stored as [_ K]. rewrite S in K.
  destruct (floats_of i s) as [p q w|]; [|discriminate]. injection K as ->. cbn [ca cb cc] in *.
  unfold float_triangle, unit_in. f_equal; apply stored_exact; intros y Y; apply I; rewrite !in_app_iff; auto.
Qed.
Lemma stored_plane p n : Contest.shape_of s = Contest.Infinite p n ->
  p = scaled unit (int p) /\ n = scaled (exponent_of (components n)) (integers_of (components n) n).
Proof.
  intros S. assert (I := surface_in).
  unfold lengths_of in I. rewrite S in I. destruct stored as [_ K]. rewrite S in K.
  destruct (floats_of i s) as [|p' n']; [discriminate|]. injection K as -> ->.
  split; apply stored_exact; auto. apply incl_refl.
Qed.
End Stored.

Section Surface.
Variable s : Contest.surface.
Hypothesis lengths_in : in_lengths b (reals (ray_origin i)) s.
Hypothesis stored : is_stored i s.
Lemma surface_in : incl (lengths_of s) (lengths b).
Proof. intros y Y. apply lengths_in, in_or_app. now right. Qed.
Definition triangle_exact := stored_triangle s surface_in stored.
Definition plane_exact := stored_plane s surface_in stored.

(** Before the clip range is looked at. *)
Theorem line_hit_right :
  match line_hit i b s with
  | None => ~ Contest.meets_closed r s
  | Some h =>
      (denominator_ h <> 0%Z <-> Contest.D r s <> 0) /\
      (Contest.D r s <> 0 ->
       t_exact (shift_in b) h = Contest.t r s /\ Contest.meets_closed r s /\
       (Hits.on_edge h = false <-> Contest.meets_within r s))
  end.
Proof.
  unfold line_hit, Contest.meets_closed, Contest.meets_within, Contest.t, Contest.T, Contest.D.
  rewrite (ray_exact s lengths_in). destruct (Contest.shape_of s) as [x|p n] eqn:S.
  - assert (X := triangle_exact x S). set (a' := int (ca x)) in *. set (b' := int (cb x)) in *.
    set (c' := int (cc x)) in *. clearbody a' b' c'. subst x.
    assert (H := hit_by_edges d o a' b' c'). cbv zeta in H.
    assert (S1 := edge_sign unit direction_unit o d a' b'). assert (S2 := edge_sign unit direction_unit o d
      b' c').
    assert (S3 := edge_sign unit direction_unit o d c' a'). cbv zeta in S1, S2, S3.
    assert (SD := denominator_sign unit direction_unit o d a' b' c'). cbv zeta in SD.
    destruct (hit d o a' b' c') as [h|] eqn:E.
    + destruct (hit_is_geometry _ _ _ _ _ _ E) as (GT & GD & _ & _ & GE).
      assert (N : denominator_ h <> 0%Z <->
        denominator (float_ray unit direction_unit o d) (float_triangle unit a' b' c') <> 0).
      { rewrite (proj2 (proj2 SD)), <- GD. split; intros K L; apply K; [now apply eq_IZR | now rewrite L]. }
      split; [exact N|]. intros ND. assert (NI : denominator (real_ray o d) (real_triangle a' b' c') <> 0).
      { intros K. now apply ND, (proj2 (proj2 SD)). }
      split.
      { unfold t_exact, ratio. rewrite GT, GD. symmetry. now apply depth_scaled. }
      split; [split; [exact ND|]; unfold float_triangle; cbn [ca cb cc]; unfold one_sided in H; lra|].
      unfold Hits.on_edge. destruct (edges h) as [|z1 [|z2 [|z3 [|]]]]; try discriminate GE.
      injection GE as E1 E2 E3. unfold meets_inside, float_triangle. cbn [ca cb cc].
      rewrite <- E1, <- E2, <- E3 in *. clear - H S1 S2 S3.
      assert (Q : existsb (Z.eqb 0) [z1; z2; z3] = false <-> IZR z1 <> 0 /\ IZR z2 <> 0 /\ IZR z3 <> 0).
      { cbn [existsb]. rewrite !orb_false_iff, !Z.eqb_neq. split.
        - intros [A [B [C _]]]. repeat split; apply not_0_IZR; lia.
        - intros [A [B C]]. repeat split; auto; intros K; rewrite <- K in *; auto. }
      rewrite Q. unfold one_sided in H. split; intros K; lra.
    + unfold meets, float_triangle. cbn [ca cb cc]. unfold one_sided in H. intros [_ K]. apply H. lra.
  - destruct (plane_exact p n S) as [P N]. set (p' := int p) in *. set (n' := integers_of (components n) n)
    in *.
    set (k := exponent_of (components n)) in *. clearbody p' n' k. subst p n.
    destruct (plane_scaled unit direction_unit o d p' n' k) as [ET ED].
    assert (T' : dot (vsub (scaled unit p') (origin (float_ray unit direction_unit o d))) (scaled k n') =
      T_of (float_ray unit direction_unit o d) (scaled unit p') (scaled k n')) by reflexivity.
    assert (D' : dot (direction (float_ray unit direction_unit o d)) (scaled k n') =
      D_of (float_ray unit direction_unit o d) (scaled k n')) by reflexivity.
    rewrite T', D'. clear T' D'.
    assert (GD : IZR (denominator_ (plane_hit d o p' n')) = D_of (real_ray o d) (real n')) by apply real_dot.
    assert (GT : IZR (numerator_ (plane_hit d o p' n')) = T_of (real_ray o d) (real p') (real n')).
    { unfold plane_hit. cbn [numerator_]. now rewrite real_dot, real_sub. }
    assert (F : 0 < bpow radix2 direction_unit * bpow radix2 k) by (apply Rmult_lt_0_compat; apply bpow_gt_0).
    assert (N : denominator_ (plane_hit d o p' n') <> 0%Z <->
      D_of (float_ray unit direction_unit o d) (scaled k n') <> 0).
    { rewrite ED, <- GD. split; intros K L.
      - apply Rmult_integral in L. destruct L as [L|L]; [lra|]. now apply K, eq_IZR.
      - apply K. rewrite L. ring. }
    split; [exact N|]. intros ND. assert (NI : D_of (real_ray o d) (real n') <> 0).
    { intros K. apply ND. rewrite ED, K. ring. }
    split; [|split; [exact ND|]; split; auto].
    unfold t_exact, ratio. rewrite GT, GD. symmetry. now apply plane_depth_scaled.
Qed.

(** Within the clip range. *)


Lemma code_hit_line h : code_hit i b s = Some h -> line_hit i b s = Some h.
Proof.
  unfold code_hit. destruct (line_hit i b s) as [h'|]; [|discriminate]. unfold _seen. intros H.
  repeat match type of H with (if ?c then _ else _) = _ => destruct c; try discriminate H end. exact H.
Qed.
Lemma end_limit_is_float : limit_is_float (end_limit i).
Proof.
  unfold limit_is_float, end_limit, end_, number_of.
  destruct (clip_end i) as [|[]| |]; try exact I; apply B2R_is_float.
Qed.

Theorem code_hit_seen h : line_hit i b s = Some h ->
  (code_hit i b s = Some h <->
   Contest.D r s <> 0 /\ Facts.in_clip_range (start i) (end_ i) (Contest.t r s)).
Proof.
  intros H. unfold code_hit. rewrite H. generalize line_hit_right. rewrite H. intros [N R].
  rewrite seen_exact; [|apply B2R_is_float | apply end_limit_is_float]. rewrite N.
  assert (Open : is_open i = true <-> start i = 0).
  { unfold is_open. case Req_bool_spec; split; auto; discriminate. }
  split.
  - intros [ND [P [A B]]]. split; [exact ND|]. destruct (R ND) as [T _]. rewrite T in *.
    split; [exact A|]. split.
    + revert B. unfold end_limit, end_. destruct (number_of (clip_end i)); simpl; auto.
    + intros [Z1 Z2]. apply P; auto. now apply Open.
  - intros [ND [A [B C]]]. destruct (R ND) as [T _]. rewrite T. split; [exact ND|].
    split; [|split; [exact A|]].
    + intros P Z. apply C. split; auto. now apply Open.
    + revert B. unfold end_limit, end_. destruct (number_of (clip_end i)); simpl; auto.
Qed.

Theorem code_hit_met : (exists h, code_hit i b s = Some h) <->
  Contest.meets_closed r s /\ Facts.in_clip_range (start i) (end_ i) (Contest.t r s).
Proof.
  generalize line_hit_right. destruct (line_hit i b s) as [h|] eqn:H.
  - intros [N R]. split.
    + intros [h' H']. assert (E := code_hit_line _ H'). rewrite H in E. injection E as <-.
      apply (code_hit_seen h H) in H'. destruct H' as [ND C]. split; [apply (R ND) | exact C].
    + intros [M C]. exists h. apply (code_hit_seen h H). split; [now apply Nearest.closed_D | exact C].
  - intros R. split; [|tauto]. intros [h' H']. apply code_hit_line in H'. congruence.
Qed.

Theorem code_hit_facts h : code_hit i b s = Some h ->
  denominator_ h <> 0%Z /\ t_exact (shift_in b) h = Contest.t r s /\
  (Hits.on_edge h = false <-> Contest.meets_within r s).
Proof.
  intros H. assert (L := code_hit_line _ H). apply (code_hit_seen _ L) in H. destruct H as [ND _].
  generalize line_hit_right. rewrite L. intros [N R]. destruct (R ND) as [A [_ B]].
  split; [now apply N|]. now split.
Qed.

(** [IntegerBatch.t] *)
Theorem integer_t_right h : true_division (division i) -> code_hit i b s = Some h ->
  integer_t i b h = Facts.nearest_float (Contest.t r s).
Proof.
  intros Div H. destruct (code_hit_facts _ H) as [N [<- _]]. unfold integer_t, Facts.nearest_float.
  rewrite (t_rounded _ _ _ Div N). case Rlt_bool_spec; intros L; [reflexivity|].
  set (t := t_exact (shift_in b) h) in *.
  assert (NZ : t <> 0).
  { intros Z. rewrite Z in L. unfold rnd in L. rewrite round_0 in L by apply valid_rnd_N.
    rewrite Rabs_R0 in L. generalize (bpow_gt_0 radix2 emax). lra. }
  assert (G := bpow_gt_0 radix2 (shift_in b)). assert (ND := not_0_IZR _ N).
  assert (E : t * IZR (denominator_ h) = IZR (numerator_ h) * bpow radix2 (shift_in b)).
  { unfold t, t_exact, ratio. field. exact ND. }
  destruct (Z.ltb_spec 0 (numerator_ h)) as [P|P], (Z.ltb_spec 0 (denominator_ h)) as [Q|Q]; simpl Bool.eqb;
    cbv iota; case Rlt_bool_spec; intros K; try reflexivity; exfalso; apply IZR_lt in P || apply IZR_le in P;
    (apply IZR_lt in Q || apply IZR_le in Q); nra.
Qed.
End Surface.

(** [gap] *)
Theorem code_gap_right s s' h h' :
  in_lengths b (reals (ray_origin i)) s -> in_lengths b (reals (ray_origin i)) s' ->
  is_stored i s -> is_stored i s' -> code_hit i b s = Some h -> code_hit i b s' = Some h' ->
  Z.compare (gap h h') 0 = Rcompare (Contest.t r s) (Contest.t r s').
Proof.
  intros I I' S S' H H'. destruct (code_hit_facts s I S _ H) as [N [<- _]].
  destruct (code_hit_facts s' I' S' _ H') as [N' [<- _]].
  destruct (gap_sign h h' N N') as [k [K E]]. unfold t_exact.
  assert (G := bpow_gt_0 radix2 (shift_in b)).
  destruct (Z.compare_spec (gap h h') 0) as [Z|Z|Z]; symmetry.
  - rewrite Z in E. apply Rcompare_Eq. assert (ratio h - ratio h' = 0) by nra. nra.
  - apply IZR_lt in Z. apply Rcompare_Lt. assert (ratio h - ratio h' < 0) by nra. nra.
  - apply IZR_lt in Z. apply Rcompare_Gt. assert (0 < ratio h - ratio h') by nra. nra.
Qed.
End Batch.
