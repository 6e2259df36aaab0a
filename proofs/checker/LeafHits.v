(** What the checker says of one surface or two (Leaf.v) is so: by what is proven of the tracer's
    integers, which have the other sign where D < 0. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Flocq Require BinarySingleNaN.
From Reftrace Require Import Geometry Trees Integers Clip Ties.
From Reftrace Require Contest Facts Hits.
From Reftrace Require Import CodeAnswers CodeIntegers Leaf.
Import ListNotations.
Open Scope Z_scope.

(** ** A hit of the tracer's, as the checker has it

    Of a plane, the checker's n, T and D are [by_] times as large: its normal has the power of two that
    all numbers have. *)

Definition times (k : Z) (v : Integers) : Integers := I3 (k * ix v) (k * iy v) (k * iz v).
Definition met_of (by_ : Z) (name : Contest.name) (h : Hit) : Met :=
  MakeMet name (by_ * numerator_ h) (by_ * denominator_ h) (times by_ (normal_ h))
    (map (fun '(e, (m, span)) => (e, m, span)) (combine (edges h) (combine (sides h) (spans h))))
    (direction_ h).
Lemma bottom_not_0 by_ name h : 0 < by_ -> denominator_ h <> 0 -> bottom (met_of by_ name h) <> 0.
Proof. unfold met_of. cbn [bottom]. nia. Qed.
Lemma ratio_met by_ name h : 0 < by_ -> denominator_ h <> 0 ->
  (IZR (top (met_of by_ name h)) / IZR (bottom (met_of by_ name h)) = ratio h)%R.
Proof.
  intros P N. unfold met_of. cbn [top bottom]. unfold ratio. rewrite !mult_IZR.
  apply not_0_IZR in N. assert (K : IZR by_ <> 0%R) by (apply not_0_IZR; lia). field. now split.
Qed.

(** ** The hit *)

(** The tracer's numbers: as one power of two is for all, of lengths and directions alike. *)
Definition in_one (p : pixel) : batch := Batch (together p) (together p).
Definition as_inputs (p : pixel) : inputs :=
  Inputs (origin p) (direction p) NothingShared (clip_start p) (clip_end p) (floats_of p)
    (fun _ _ => in_one p) (fun _ _ => in_one p) (division p) (fun _ => None).

(** A plane's normal by itself has a greater power of two. *)
Definition more (xs ys : list R) : Z := 2 ^ Z.max 0 (least ys - least xs).
Lemma more_pos xs ys : 0 < more xs ys.
Proof. unfold more. apply Z.pow_pos_nonneg; lia. Qed.
Lemma nonzero_incl xs ys : incl ys xs -> incl (nonzero ys) (nonzero xs).
Proof. intros I y Y. apply filter_In in Y. apply filter_In. split; [now apply I | apply Y]. Qed.
Lemma shifted_more xs ys y : incl ys xs -> In y ys -> shifted xs y = more xs ys * shifted ys y.
Proof.
  intros I Y. unfold shifted. destruct (Req_bool_spec y 0) as [->|N].
  { unfold digits. rewrite Rmult_0_l, Ztrunc_IZR. cbn. lia. }
  assert (J : In y (nonzero ys)).
  { apply filter_In. split; [exact Y|]. now rewrite Req_bool_false. }
  assert (A : least ys <= exponent y) by now apply min_le, in_map.
  assert (B : least xs <= least ys).
  { unfold least at 2. destruct (nonzero ys) as [|z l] eqn:E; [destruct J|]. cbn [map min_].
    assert (G : forall k, In k (map exponent (z :: l)) -> least xs <= k).
    { intros k K. apply in_map_iff in K. destruct K as (w & <- & W). apply min_le, in_map.
      apply (nonzero_incl xs ys I). now rewrite E. }
    assert (F : forall l m, least xs <= m -> (forall k, In k l -> least xs <= k) ->
      least xs <= fold_right Z.min m l).
    { induction l0 as [|k l0 IH]; intros m M L; cbn [fold_right]; [exact M|].
      apply Z.min_glb; [apply L; now left | apply IH; auto; intros; apply L; now right]. }
    apply F; [apply G; now left|]. intros k K. apply G. now right. }
  rewrite !Z.shiftl_mul_pow2 by lia. unfold more. rewrite Z.max_r by lia.
  replace (exponent y - least xs) with (least ys - least xs + (exponent y - least ys)) by lia.
  rewrite Z.pow_add_r by lia. ring.
Qed.
Definition by_of (p : pixel) (s : Contest.surface) : Z :=
  match Contest.shape_of s with
  | Contest.Triangular _ => 1
  | Contest.Infinite _ n => more (together p) (components n)
  end.
Lemma by_pos p s : 0 < by_of p s.
Proof. unfold by_of. destruct (Contest.shape_of s); [lia | apply more_pos]. Qed.

(** What the clip range asks, of T / D. *)
Definition in_ends (first last : Z * Z) (T D : Z) : bool :=
  let k := if D <? 0 then -1 else 1 in
  (fst first * (k * D) <=? k * T * snd first) && (k * T * snd last <=? fst last * (k * D))
  && negb ((T =? 0) && (fst first =? 0)).
Definition not_empty (first last : Z * Z) : Prop :=
  0 < snd first /\ 0 <= snd last /\ fst first * snd last < fst last * snd first.

Lemma min_spec l : 0 <= min_ l <-> Forall (fun x => 0 <= x) l.
Proof.
  destruct l as [|a l]; [split; [constructor | cbn; lia]|]. cbn [min_]. rewrite Forall_cons_iff.
  induction l as [|b l IH]; cbn [fold_right]; [intuition constructor|].
  rewrite Forall_cons_iff, Z.min_glb_iff, IH. tauto.
Qed.
Lemma max_spec l : max_ l <= 0 <-> Forall (fun x => x <= 0) l.
Proof.
  destruct l as [|a l]; [split; [constructor | cbn; lia]|]. cbn [max_]. rewrite Forall_cons_iff.
  induction l as [|b l IH]; cbn [fold_right]; [intuition constructor|].
  rewrite Forall_cons_iff, Z.max_lub_iff, IH. tauto.
Qed.
Lemma mixed_spec l : mixed l = false <-> Forall (fun x => 0 <= x) l \/ Forall (fun x => x <= 0) l.
Proof. unfold mixed. now rewrite andb_false_iff, !Z.ltb_ge, min_spec, max_spec. Qed.
Lemma ends_right first last values T D : not_empty first last ->
  values = [] \/ (exists e1 e2 e3, values = [e1; e2; e3] /\ D = e1 + (e2 + (e3 + 0))) ->
  D <> 0 ->
  negb (mixed (ends first last T D ++ values)) && negb ((T =? fst first) && (fst first =? 0)) =
  negb (mixed values) && in_ends first last T D.
Proof.
  destruct first as [a b], last as [c e]. unfold not_empty, ends, in_ends. cbn [fst snd].
  intros (B & E & R) V N.
  assert (S : e * (T * b - a * D) + b * (c * D - T * e) = D * (c * b - a * e)) by ring.
  set (s1 := T * b - a * D) in *. set (s2 := c * D - T * e) in *.
  assert (Up : 0 < D -> ~ (s1 <= 0 /\ s2 <= 0)) by nia.
  assert (Down : D < 0 -> ~ (0 <= s1 /\ 0 <= s2)) by nia.
  assert (Q1 : forall k, (a * (k * D) <=? k * T * b) = (0 <=? k * s1)).
  { intros k'. unfold s1.
    destruct (Z.leb_spec (a * (k' * D)) (k' * T * b)), (Z.leb_spec 0 (k' * (T * b - a * D))); lia. }
  assert (Q2 : forall k, (k * T * e <=? c * (k * D)) = (0 <=? k * s2)).
  { intros k'. unfold s2.
    destruct (Z.leb_spec (k' * T * e) (c * (k' * D))), (Z.leb_spec 0 (k' * (c * D - T * e))); lia. }
  assert (Q3 : ((T =? a) && (a =? 0)) = ((T =? 0) && (a =? 0))).
  { destruct (Z.eqb_spec T 0), (Z.eqb_spec a 0), (Z.eqb_spec T a); reflexivity || lia. }
  rewrite Q1, Q2, Q3. rewrite andb_assoc. f_equal.
  clear Q1 Q2 Q3 S. clearbody s1 s2.
  apply eq_iff_eq_true. rewrite !andb_true_iff, !negb_true_iff, !mixed_spec, !Z.leb_le.
  destruct V as [->|(e1 & e2 & e3 & -> & D_is)]; cbn [app]; rewrite ?Forall_cons_iff;
    assert (F : forall P, Forall P (@nil Z) <-> True) by (split; constructor); rewrite !F; clear F;
    destruct (Z.ltb_spec D 0); lia.
Qed.

(** The line meets the surface, and then the clip range is looked at. *)
Lemma exact_hit_line p s : not_empty (start_ratio p) (end_ratio p) ->
  match Contest.shape_of s with Contest.Infinite _ n => incl (components n) (together p) | _ => True end ->
  exact_hit p s =
  match line_hit (as_inputs p) (in_one p) s with
  | None => None
  | Some h =>
      if denominator_ h =? 0 then None else
      let m := met_of (by_of p s) (Contest.called s) h in
      if in_ends (start_ratio p) (end_ratio p) (top m) (bottom m) then Some m else None
  end.
Proof.
  intros R I. unfold exact_hit, line_hit, by_of.
  change (origin_in (as_inputs p) (in_one p)) with (whole p (reals (origin p))).
  change (direction_in (as_inputs p) (in_one p)) with (whole p (reals (direction p))).
  change (integers_of (lengths (in_one p))) with (whole p).
  set (o := whole p (reals (origin p))). set (d := whole p (reals (direction p))). clearbody o d.
  destruct (Contest.shape_of s) as [x|q n].
  - set (a := whole p (ca x)). set (b := whole p (cb x)). set (c := whole p (cc x)). clearbody a b c.
    unfold hit, of_triangle, Integers.hit, _triangle. cbn [map].
    set (a' := _sub a o). set (b' := _sub b o). set (c' := _sub c o). clearbody a' b' c'.
    set (n := _add (_add (_cross a' b') (_cross b' c')) (_cross c' a')).
    assert (E : _cross (_sub a' b') (_sub b' c') = n).
    { unfold n, _cross, _sub, _add. cbn [ix iy iz]. f_equal; ring. }
    rewrite E. set (v := [_dot d (_cross a' b'); _dot d (_cross b' c'); _dot d (_cross c' a')]).
    assert (T : _dot a' n = _dot a' (_cross b' c')).
    { unfold n, _dot, _add, _cross. cbn [ix iy iz]. ring. }
    assert (D : _dot d n = sum v).
    { unfold n, v, sum, _dot, _add, _cross. cbn [ix iy iz fold_right]. ring. }
    rewrite T, D. destruct (Z.eqb_spec (sum v) 0) as [Z|N].
    { rewrite Z. fold (mixed v). now destruct (mixed v). }
    assert (G := ends_right _ _ v (_dot a' (_cross b' c')) (sum v) R
      (or_intror (ex_intro _ _ (ex_intro _ _ (ex_intro _ _ (conj eq_refl eq_refl))))) N).
    fold (mixed v). destruct (mixed v).
    + cbn [andb negb] in G. destruct (mixed _); [reflexivity|]. cbn [andb negb] in G.
      destruct (_ && _); [reflexivity | discriminate].
    + cbn [andb negb] in G. unfold met_of.
      cbn [denominator_ top bottom numerator_ normal_ edges sides spans direction_ combine map].
      apply Z.eqb_neq in N. rewrite N. cbv zeta. rewrite !Z.mul_1_l, <- G.
      destruct (mixed _); [reflexivity|]. cbn [andb negb].
      match goal with |- context [if negb ?t then _ else _] => destruct t end; [reflexivity|]. cbn [negb].
      do 2 f_equal. unfold times. destruct n as [nx ny nz]. cbn [ix iy iz]. f_equal; lia.
  - set (n' := integers_of (components n) n). set (k := more (together p) (components n)).
    assert (E : whole p n = times k n').
    { unfold whole, n', integers_of, times. cbn [ix iy iz].
      rewrite !(shifted_more (together p) (components n)) by (exact I || (unfold components; simpl; tauto)).
      reflexivity. }
    rewrite E. assert (P : 0 < k) by apply more_pos. clearbody k n'. set (q' := whole p q). clearbody q'.
    unfold hit, of_plane, plane_hit. cbn [map denominator_]. rewrite app_nil_r.
    assert (T : _dot (_sub q' o) (times k n') = k * _dot (_sub q' o) n').
    { unfold _dot, times. cbn [ix iy iz]. ring. }
    assert (D : _dot d (times k n') = k * _dot d n').
    { unfold _dot, times. cbn [ix iy iz]. ring. }
    rewrite T, D. set (T0 := _dot (_sub q' o) n'). set (D0 := _dot d n'). clearbody T0 D0.
    destruct (Z.eqb_spec D0 0) as [->|N]; [now rewrite Z.mul_0_r|].
    assert (N' : k * D0 <> 0) by nia.
    assert (G := ends_right _ _ [] (k * T0) (k * D0) R (or_introl eq_refl) N').
    rewrite app_nil_r in G. apply Z.eqb_neq in N'. rewrite N'.
    unfold met_of. cbn [denominator_ top bottom numerator_ normal_ edges sides spans direction_ combine map].
    change (mixed []) with false in G. cbn [andb negb] in G. cbv zeta. rewrite <- G.
    destruct (mixed _); [reflexivity|]. cbn [andb negb].
    match goal with |- context [if negb ?t then _ else _] => destruct t end; reflexivity.
Qed.

(** ** The clip range *)

(** What [float.as_integer_ratio] is expected to make of the clip range's ends: these are fractions.
    Trusted, like Python's division. *)
Definition is_ratio (limit : Contest.number) (r : Z * Z) : Prop :=
  match limit with
  | Contest.Finite x => 0 < snd r /\ (IZR (fst r) / IZR (snd r) = x)%R
  | Contest.Infinity => r = (1, 0)
  | Contest.MinusInfinity => r = (-1, 0)
  end.

Lemma fraction_le a b c e : 0 < b -> 0 < e -> a * e <= c * b <-> (IZR a / IZR b <= IZR c / IZR e)%R.
Proof.
  intros B E. apply IZR_lt in B, E.
  assert (P : (0 < / (IZR b * IZR e))%R) by (apply Rinv_0_lt_compat; nra).
  assert (L : (IZR a / IZR b = / (IZR b * IZR e) * (IZR a * IZR e))%R) by (field; lra).
  assert (K : (IZR c / IZR e = / (IZR b * IZR e) * (IZR c * IZR b))%R) by (field; lra).
  rewrite L, K. clear L K. split; intros H.
  - apply IZR_le in H. rewrite !mult_IZR in H. apply Rmult_le_compat_l; lra.
  - apply Rmult_le_reg_l in H; [|exact P]. rewrite <- !mult_IZR in H. now apply le_IZR.
Qed.
Section Clip.
Variables (start : R) (end_ : Contest.number) (first last : Z * Z).
Hypothesis first_is : is_ratio (Contest.Finite start) first.
Hypothesis last_is : is_ratio end_ last.
Hypothesis range_is : Contest.less (Contest.Finite start) end_ = true.
Lemma range_not_empty : not_empty first last.
Proof.
  destruct first_is as [P E]. unfold not_empty, is_ratio in *. split; [exact P|].
  destruct end_ as [|e|]; [discriminate | |].
  - destruct last_is as [P' E']. split; [lia|]. cbn in range_is.
    apply Z.nle_gt. intros L. apply (fraction_le _ _ _ _ P' P) in L. revert range_is.
    rewrite E, E' in L. unfold Rlt_bool. case Rcompare_spec; intros; easy || lra.
  - rewrite last_is. cbn [fst snd]. lia.
Qed.
Theorem in_ends_right T D : D <> 0 ->
  in_ends first last T D = true <-> Facts.in_clip_range start end_ (IZR T / IZR D).
Proof.
  intros N. unfold in_ends. set (k := if D <? 0 then -1 else 1).
  assert (P : 0 < k * D) by (unfold k; destruct (Z.ltb_spec D 0); lia).
  assert (K : (IZR T / IZR D = IZR (k * T) / IZR (k * D))%R).
  { assert (K0 : k <> 0) by (unfold k; destruct (D <? 0); lia). rewrite !mult_IZR.
    apply not_0_IZR in N, K0. field. now split. }
  assert (K' : T = 0 <-> k * T = 0) by (unfold k; destruct (D <? 0); lia).
  rewrite !andb_true_iff, negb_true_iff, andb_false_iff, !Z.leb_le, !Z.eqb_neq, K, K'.
  destruct first_is as [P1 <-]. unfold Facts.in_clip_range.
  rewrite (fraction_le (fst first) (snd first) (k * T) (k * D) P1 P).
  assert (E : k * T * snd last <= fst last * (k * D) <->
    match end_ with
    | Contest.Finite e => (IZR (k * T) / IZR (k * D) <= e)%R
    | Contest.Infinity => True
    | Contest.MinusInfinity => False
    end).
  { unfold is_ratio in last_is. destruct end_ as [|e|]; [discriminate | |].
    - destruct last_is as [P2 <-]. now apply fraction_le.
    - rewrite last_is. cbn [fst snd]. lia. }
  assert (Z0 : forall a b, 0 < b -> a = 0 <-> (IZR a / IZR b = 0)%R).
  { intros a b B. apply IZR_lt in B. split; [intros ->; unfold Rdiv; ring|]. intros H.
    apply Rmult_integral in H. destruct H as [H|H]; [now apply eq_IZR|].
    apply Rinv_neq_0_compat in H; [easy | lra]. }
  rewrite <- (Z0 _ _ P), <- (Z0 _ _ P1), E. tauto.
Qed.
End Clip.

(** Fractions *)
Theorem compare_ratios_right T D T' D' : D <> 0 -> D' <> 0 ->
  compare_ratios T D T' D' = Rcompare (IZR T / IZR D) (IZR T' / IZR D').
Proof.
  intros N N'. unfold compare_ratios. apply not_0_IZR in N, N'.
  assert (P : (0 < (IZR D * IZR D) * (IZR D' * IZR D'))%R).
  { assert (0 < IZR D * IZR D)%R by now apply Rsqr_pos_lt.
    assert (0 < IZR D' * IZR D')%R by now apply Rsqr_pos_lt. nra. }
  rewrite <- (Rcompare_mult_r _ (IZR T / IZR D) _ P), <- Rcompare_IZR.
  f_equal; rewrite !mult_IZR; field; assumption.
Qed.

(** ** The rule *)

Lemma zfirst_scaled k l : k <> 0 -> zfirst (map (Z.mul k) l) = k * zfirst l.
Proof.
  intros K. induction l as [|a l IH]; cbn [map zfirst fold_right]; [lia|].
  fold (zfirst (map (Z.mul k) l)). fold (zfirst l). rewrite IH.
  destruct (Z.eqb_spec a 0) as [->|N]; [now rewrite Z.mul_0_r|].
  destruct (Z.eqb_spec (k * a) 0); [lia | reflexivity].
Qed.
Lemma moved_scaled k e m edge d moves : k <> 0 ->
  Leaf.moved (k * e) (times k m) (times k edge) d moves = k * Leaf.moved e m edge d moves.
Proof.
  intros K. unfold Leaf.moved. rewrite <- (zfirst_scaled k) by exact K. apply (f_equal zfirst).
  cbn [map]. rewrite map_app, map_map. f_equal. f_equal.
  - apply map_ext. intros u. unfold _dot, times. cbn [ix iy iz]. ring.
  - assert (Zero : is_zero (times k m) = is_zero m).
    { unfold is_zero, times. cbn [ix iy iz].
      assert (Q : forall x, (k * x =? 0) = (x =? 0))
        by (intros x; destruct (Z.eqb_spec x 0), (Z.eqb_spec (k * x) 0); lia).
      now rewrite !Q. }
    rewrite Zero. destruct (is_zero m); [|reflexivity].
    rewrite concat_map. f_equal. unfold rows. rewrite map_map. apply map_ext. intros u.
    rewrite map_map. apply map_ext. intros v. unfold _dot, _cross, times. cbn [ix iy iz]. ring.
Qed.
Lemma moved_sign e m edge d moves : Z.sgn (Leaf.moved e m edge d moves) = _sign e m edge d moves.
Proof. symmetry. apply sign_is_first. Qed.
Lemma moved_value e m edge d moves : e <> 0 -> Leaf.moved e m edge d moves = e.
Proof. intros N. unfold Leaf.moved. cbn [zfirst fold_right]. now apply Z.eqb_neq in N as ->. Qed.

(** The order of two hits *)
Theorem order_right k n h k' n' h' moves : 0 < k -> 0 < k' -> denominator_ h <> 0 -> denominator_ h' <> 0 ->
  Z.sgn (order moves (met_of k n h) (met_of k' n' h')) = Hits.sign_of_difference moves h h'.
Proof.
  intros P P' N N'. unfold order, line, met_of. cbn [top bottom Leaf.normal along].
  assert (K : k <> 0) by lia. assert (K' : k' <> 0) by lia.
  assert (M : moved (k * numerator_ h * (k' * denominator_ h') - k' * numerator_ h' * (k * denominator_ h))
      (I3 (k * numerator_ h * ix (times k' (normal_ h')) - k' * numerator_ h' * ix (times k (normal_ h)))
          (k * numerator_ h * iy (times k' (normal_ h')) - k' * numerator_ h' * iy (times k (normal_ h)))
          (k * numerator_ h * iz (times k' (normal_ h')) - k' * numerator_ h' * iz (times k (normal_ h))))
      (if k * numerator_ h =? 0 then _cross (times k (normal_ h)) (times k' (normal_ h')) else ZERO)
      (direction_ h) moves =
    (k * k') * moved (numerator_ h * denominator_ h' - numerator_ h' * denominator_ h)
      (fst (Hits.intersection h h')) (snd (Hits.intersection h h')) (direction_ h) moves).
  { rewrite <- moved_scaled by lia. unfold Hits.intersection. cbn [fst snd].
    f_equal.
    - ring.
    - unfold times. cbn [ix iy iz]. f_equal; ring.
    - destruct (Z.eqb_spec (numerator_ h) 0) as [E|E], (Z.eqb_spec (k * numerator_ h) 0); try lia;
        unfold times, _cross, ZERO; cbn [ix iy iz]; f_equal; ring. }
  rewrite M, !Z.sgn_mul, moved_sign. unfold Hits.sign_of_difference.
  replace (Z.sgn k) with 1 by lia. replace (Z.sgn k') with 1 by lia. rewrite !Z.mul_1_l.
  generalize (_sign (numerator_ h * denominator_ h' - numerator_ h' * denominator_ h)
    (fst (Hits.intersection h h')) (snd (Hits.intersection h h')) (direction_ h) moves). intros v.
  destruct (Z.ltb_spec 0 (denominator_ h)), (Z.ltb_spec 0 (denominator_ h')); simpl Bool.eqb; cbv iota.
  - rewrite (Z.sgn_pos (denominator_ h)), (Z.sgn_pos (denominator_ h')) by lia. lia.
  - rewrite (Z.sgn_pos (denominator_ h)), (Z.sgn_neg (denominator_ h')) by lia. lia.
  - rewrite (Z.sgn_neg (denominator_ h)), (Z.sgn_pos (denominator_ h')) by lia. lia.
  - rewrite (Z.sgn_neg (denominator_ h)), (Z.sgn_neg (denominator_ h')) by lia. lia.
Qed.

(** What is crossed. A hit has no edges, or three, whose e have one sign and D for their sum. *)
Definition is_hit (h : Hit) : Prop :=
  (edges h = [] /\ sides h = [] /\ spans h = []) \/
  exists e1 e2 e3 m1 m2 m3 s1 s2 s3, edges h = [e1; e2; e3] /\ sides h = [m1; m2; m3] /\
    spans h = [s1; s2; s3] /\ denominator_ h = e1 + (e2 + (e3 + 0)) /\
    ((0 <= e1 /\ 0 <= e2 /\ 0 <= e3) \/ (e1 <= 0 /\ e2 <= 0 /\ e3 <= 0)).
Theorem is_crossed_right k n h moves : 0 < k -> is_hit h -> denominator_ h <> 0 ->
  is_crossed moves (met_of k n h) = Hits.is_crossed moves h.
Proof.
  intros P H N. unfold is_crossed, met_of, Hits.is_crossed, Hits.on_edge.
  cbn [rims bottom along].
  destruct H as [(-> & -> & ->)|H]; [reflexivity|].
  destruct H as (e1 & e2 & e3 & m1 & m2 & m3 & s1 & s2 & s3 & -> & -> & -> & D & S).
  rewrite D in N |- *. clear D. cbn [combine map forallb existsb].
  rewrite <- !moved_sign.
  generalize (moved_value e1 m1 s1 (direction_ h) moves) (moved_value e2 m2 s2 (direction_ h) moves)
    (moved_value e3 m3 s3 (direction_ h) moves).
  generalize (moved e1 m1 s1 (direction_ h) moves) (moved e2 m2 s2 (direction_ h) moves)
    (moved e3 m3 s3 (direction_ h) moves). intros v1 v2 v3 V1 V2 V3.
  apply eq_iff_eq_true.
  assert (R : forall v, (1 =? Z.sgn v) = (0 <? v)) by (intros []; reflexivity).
  assert (L : forall v, (-1 =? Z.sgn v) = (v <? 0)) by (intros []; reflexivity).
  set (D := e1 + (e2 + (e3 + 0))) in *.
  assert (Q : forall v, (0 <? k * D * v) = (0 <? D * v)).
  { intros v. replace (k * D * v) with (k * (D * v)) by ring.
    destruct (Z.ltb_spec 0 (k * (D * v))), (Z.ltb_spec 0 (D * v)); nia. }
  assert (U : forall v, 0 < D * v <-> if 0 <? D then 0 < v else v < 0)
    by (intros v; destruct (Z.ltb_spec 0 D); nia).
  rewrite !R, !L, !Q, !andb_true_r, !orb_false_r, !andb_true_iff.
  destruct (Z.eqb_spec 0 e1), (Z.eqb_spec 0 e2), (Z.eqb_spec 0 e3); cbn [orb negb];
    rewrite ?orb_true_iff, ?andb_true_iff, ?Z.ltb_lt, !U; clear Q U R L;
    destruct (Z.ltb_spec 0 D); unfold D in *; lia.
Qed.
Lemma values_met k n h : is_hit h -> values (met_of k n h) = edges h.
Proof.
  unfold values, met_of. cbn [rims]. intros [(-> & -> & ->)|H]; [reflexivity|].
  now destruct H as (e1 & e2 & e3 & m1 & m2 & m3 & s1 & s2 & s3 & -> & -> & -> & _).
Qed.
