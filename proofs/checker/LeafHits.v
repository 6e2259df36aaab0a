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

(** ** A hit of the tracer's, as the checker has it *)

Definition met_of (name : Contest.name) (h : Hit) : Met :=
  let '(T, D, n) := turned_round (denominator_ h <? 0) (numerator_ h) (denominator_ h) (normal_ h) in
  MakeMet name T D n (edges h) (combine (sides h) (spans h))
    (if 0 <? denominator_ h then 1 else -1) (direction_ h).
Definition sign_of (h : Hit) : Z := if denominator_ h <? 0 then -1 else 1.
Definition times (k : Z) (v : Integers) : Integers := I3 (k * ix v) (k * iy v) (k * iz v).
Lemma met_of_turned name h : let m := met_of name h in let k := sign_of h in
  top m = k * numerator_ h /\ bottom m = k * denominator_ h /\ Leaf.normal m = times k (normal_ h) /\
  named m = name /\ values m = edges h /\ rims m = combine (sides h) (spans h) /\
  along m = direction_ h.
Proof.
  unfold met_of, sign_of, turned_round, times, _sub, ZERO. destruct (denominator_ h <? 0).
  all: cbn [top bottom Leaf.normal named values rims along ix iy iz].
  all: repeat split; try reflexivity; try lia.
  destruct (normal_ h) as [x y z]. cbn [ix iy iz]. f_equal; lia.
Qed.
Lemma bottom_above name h : denominator_ h <> 0 -> 0 < bottom (met_of name h).
Proof.
  intros N. destruct (met_of_turned name h) as [_ [-> _]]. unfold sign_of.
  destruct (Z.ltb_spec (denominator_ h) 0); lia.
Qed.
Lemma ratio_met name h : denominator_ h <> 0 ->
  (IZR (top (met_of name h)) / IZR (bottom (met_of name h)) = ratio h)%R.
Proof.
  intros N. destruct (met_of_turned name h) as [-> [-> _]]. unfold ratio. rewrite !mult_IZR.
  apply not_0_IZR in N. unfold sign_of. destruct (denominator_ h <? 0); field; exact N.
Qed.

(** ** The hit *)

Definition as_inputs (p : pixel) : inputs :=
  Inputs (origin p) (direction p) NothingShared (clip_start p) (clip_end p) (floats_of p)
    (fun _ _ => together p) (fun _ _ => together p) (division p) (fun _ => None).

(** The line meets the surface, and then the clip range is looked at. *)
Lemma exact_hit_line p s : exact_hit p s =
  match line_hit (as_inputs p) (together p) s with
  | None => None
  | Some h =>
      if denominator_ h =? 0 then None else
      let m := met_of (Contest.called s) h in
      if clipped (start_ratio p) (end_ratio p) (top m) (bottom m) then None else Some m
  end.
Proof.
  unfold exact_hit, line_hit. change (origin_in (as_inputs p) (together p)) with (o p).
  change (direction_in (as_inputs p) (together p)) with (d p).
  change (integers_of (lengths (together p))) with (length_of p).
  destruct (Contest.shape_of s) as [x|q n].
  - set (a := length_of p (ca x)). set (b := length_of p (cb x)). set (c := length_of p (cc x)).
    clearbody a b c. set (o := o p). set (d := d p). clearbody o d.
    unfold hit, of_triangle, Integers.hit, _triangle. cbn [map fst].
    set (a' := _sub a o). set (b' := _sub b o). set (c' := _sub c o). clearbody a' b' c'.
    set (v := [_dot d (_cross a' b'); _dot d (_cross b' c'); _dot d (_cross c' a')]).
    assert (E : _dot a' (_add (_add (_cross a' b') (_cross b' c')) (_cross c' a')) = _dot a' (_cross b' c')).
    { unfold _dot, _add, _cross. cbn [ix iy iz]. ring. }
    rewrite E. destruct ((min_ v <? 0) && (0 <? max_ v)); [now destruct (sum v =? 0)|].
    cbn [denominator_]. destruct (sum v =? 0); [reflexivity|].
    unfold met_of. cbn [numerator_ denominator_ normal_ edges sides spans direction_ combine].
    destruct (turned_round _ _ _ _) as [[T D] m]. reflexivity.
  - unfold hit, of_plane, plane_hit. cbn [map fst min_ max_ denominator_ andb].
    destruct (_ =? 0); [reflexivity|]. cbn [Z.ltb Z.compare andb].
    unfold met_of. cbn [numerator_ denominator_ normal_ edges sides spans direction_ combine].
    destruct (turned_round _ _ _ _) as [[T D] m]. reflexivity.
Qed.

(** ** The clip range *)

(** What Python's [Fraction] is expected to make of the clip range's ends: these are fractions, in
    units of t's power of two. Trusted, like its division. *)
Definition is_ratio (unit : R) (limit : Contest.number) (r : Z * Z) : Prop :=
  match limit with
  | Contest.Finite x => 0 < snd r /\ (IZR (fst r) / IZR (snd r) * unit = x)%R
  | Contest.Infinity => r = (1, 0)
  | Contest.MinusInfinity => r = (-1, 0)
  end.

Section Clip.
Variables (unit start : R) (end_ : Contest.number) (first last : Z * Z).
Hypothesis unit_pos : (0 < unit)%R.
Hypothesis first_is : is_ratio unit (Contest.Finite start) first.
Hypothesis last_is : is_ratio unit end_ last.
Hypothesis end_is : end_ <> Contest.MinusInfinity.

Lemma fraction_le a b c e : 0 < b -> 0 < e ->
  a * e <= c * b <-> (IZR a / IZR b * unit <= IZR c / IZR e * unit)%R.
Proof.
  intros B E. apply IZR_lt in B, E.
  assert (P : (0 < unit / (IZR b * IZR e))%R) by (apply Rdiv_lt_0_compat; [exact unit_pos | nra]).
  assert (L : (IZR a / IZR b * unit = unit / (IZR b * IZR e) * (IZR a * IZR e))%R) by (field; lra).
  assert (K : (IZR c / IZR e * unit = unit / (IZR b * IZR e) * (IZR c * IZR b))%R) by (field; lra).
  rewrite L, K. clear L K. split; intros H.
  - apply IZR_le in H. rewrite !mult_IZR in H. apply Rmult_le_compat_l; lra.
  - apply Rmult_le_reg_l in H; [|exact P]. rewrite <- !mult_IZR in H. now apply le_IZR.
Qed.
Theorem clipped_right T D : 0 < D ->
  clipped first last T D = false <->
  Facts.in_clip_range start end_ (IZR T / IZR D * unit).
Proof.
  intros P. unfold clipped. rewrite !orb_false_iff, andb_false_iff, !Z.ltb_ge, !Z.eqb_neq.
  destruct first_is as [P1 <-]. unfold Facts.in_clip_range.
  rewrite (fraction_le (fst first) (snd first) T D P1 P).
  assert (E : fst last * D >= T * snd last <->
    match end_ with
    | Contest.Finite e => (IZR T / IZR D * unit <= e)%R
    | Contest.Infinity => True
    | Contest.MinusInfinity => False
    end).
  { unfold is_ratio in last_is. destruct end_ as [|e|]; [easy | |].
    - destruct last_is as [P2 <-]. rewrite <- (fraction_le T D (fst last) (snd last) P P2). lia.
    - rewrite last_is. cbn [fst snd]. lia. }
  assert (Z0 : forall a b, 0 < b -> a = 0 <-> (IZR a / IZR b * unit = 0)%R).
  { intros a b B. apply IZR_lt in B. split; [intros ->; unfold Rdiv; ring|]. intros H.
    apply Rmult_integral in H. destruct H as [H|H]; [|lra]. apply Rmult_integral in H.
    destruct H as [H|H]; [now apply eq_IZR|]. apply Rinv_neq_0_compat in H; [easy | lra]. }
  rewrite <- (Z0 _ _ P), <- (Z0 _ _ P1).
  assert (G : T * snd last <= fst last * D <-> fst last * D >= T * snd last) by lia.
  rewrite G, E. clear. split; intros [[A B] C] || intros [A [B C]]; repeat split; auto; lia.
Qed.
End Clip.

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
      assert (Q : forall x, (k * x =? 0) = (x =? 0)) by (intros x; destruct (Z.eqb_spec x 0), (Z.eqb_spec (k * x) 0); lia).
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
Theorem order_right n h n' h' moves : denominator_ h <> 0 -> denominator_ h' <> 0 ->
  Z.sgn (order moves (met_of n h) (met_of n' h')) = Hits.sign_of_difference moves h h'.
Proof.
  intros N N'. unfold order, line.
  destruct (met_of_turned n h) as (T1 & D1 & N1 & _ & _ & _ & A).
  destruct (met_of_turned n' h') as (T2 & D2 & N2 & _ & _ & _ & _).
  rewrite T1, D1, N1, T2, D2, N2, A. clear T1 D1 N1 T2 D2 N2 A.
  set (k := sign_of h). set (k' := sign_of h').
  assert (K : k <> 0) by (unfold k, sign_of; destruct (denominator_ h <? 0); lia).
  assert (K' : k' <> 0) by (unfold k', sign_of; destruct (denominator_ h' <? 0); lia).
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
  rewrite M, Z.sgn_mul, moved_sign. unfold Hits.sign_of_difference, k, k', sign_of.
  generalize (_sign (numerator_ h * denominator_ h' - numerator_ h' * denominator_ h)
    (fst (Hits.intersection h h')) (snd (Hits.intersection h h')) (direction_ h) moves). intros v.
  destruct (Z.ltb_spec (denominator_ h) 0), (Z.ltb_spec (denominator_ h') 0),
    (Z.ltb_spec 0 (denominator_ h)), (Z.ltb_spec 0 (denominator_ h')); try lia;
    simpl Bool.eqb; cbv iota; simpl Z.sgn; lia.
Qed.

(** What is crossed. A hit has no edges, or three, whose e have one sign and D for their sum. *)
Definition is_hit (h : Hit) : Prop :=
  (edges h = [] /\ sides h = [] /\ spans h = []) \/
  exists e1 e2 e3 m1 m2 m3 s1 s2 s3, edges h = [e1; e2; e3] /\ sides h = [m1; m2; m3] /\
    spans h = [s1; s2; s3] /\ denominator_ h = e1 + (e2 + (e3 + 0)) /\
    ((0 <= e1 /\ 0 <= e2 /\ 0 <= e3) \/ (e1 <= 0 /\ e2 <= 0 /\ e3 <= 0)).
Theorem is_crossed_right n h moves : is_hit h -> denominator_ h <> 0 ->
  is_crossed moves (met_of n h) = Hits.is_crossed moves h.
Proof.
  intros H N. unfold is_crossed.
  destruct (met_of_turned n h) as (_ & _ & _ & _ & -> & -> & ->).
  assert (Tu : turn (met_of n h) = if 0 <? denominator_ h then 1 else -1).
  { unfold met_of, turned_round. now destruct (denominator_ h <? 0). }
  rewrite Tu. clear Tu. unfold Hits.is_crossed, Hits.on_edge.
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
  rewrite !R, !L, !andb_true_r, !orb_false_r, !andb_true_iff.
  destruct (Z.eqb_spec 0 e1), (Z.eqb_spec 0 e2), (Z.eqb_spec 0 e3); cbn [orb negb];
    rewrite ?orb_true_iff, ?andb_true_iff, ?Z.ltb_lt;
    destruct (Z.ltb_spec 0 (e1 + (e2 + (e3 + 0)))); try lia; intuition lia.
Qed.
