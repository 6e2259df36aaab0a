(** Overflow, infinities and NaN in [_quotient]: in binary64, as numpy executes it.

    The other files compute in real numbers, as if there were no largest float. Here is why that is
    enough: where e is inf the test is False ([infinite_error]), and where the test is True and the
    result finite, no operation of [_quotient] has over- or underflown to anything else than what
    the real numbers say ([quotient64_real]). Its inputs are finite then: [_dot], which made them of
    sums, differences and products alone, has not overflown either (such an operation is finite
    only of what is finite: [plus_finite] and its like, [Trees.v]). *)
Require Import ZArith Reals Psatz Bool.
From Reftrace Require Import Trees Rounding Digits ScalarProduct CrossProduct Ziv Quotient.
From Flocq Require Import Core BinarySingleNaN.
Open Scope R_scope.

Notation float := Trees.float.
Notation add := (Bplus mode_NE).
Notation sub := (Bminus mode_NE).
Notation mul := (Bmult mode_NE).
Definition same64 (a b : float) : bool := match Bcompare a b with Some Eq => true | _ => false end.
Definition less64 (a b : float) : bool := match Bcompare a b with Some Lt => true | _ => false end.

(** ** e is inf *)

Definition endless (e : float) : Prop := e = B754_infinity false \/ e = B754_nan.

(** Whatever c and q are. *)
Lemma endless_fails (left error near : float) : endless error ->
  same64 (add (sub left error) near) (add (add left error) near) = false.
Proof.
  intros [-> | ->]; destruct left as [[]|[]| |[] ? ? ?], near as [[]|[]| |[] ? ? ?]; reflexivity.
Qed.

Lemma endless_mul x y : endless x -> Bsign y = false -> endless (mul x y).
Proof.
  intros [-> | ->] S; destruct y as [[]|[]| |[] ? ? ?]; try discriminate; (now left) || (now right).
Qed.
Lemma endless_abs x y : endless x -> endless (mul x (Babs y)).
Proof. intros H. destruct y as [[]|[]| |[] ? ? ?], H as [-> | ->]; (now left) || (now right). Qed.
Lemma abs_endless x y : endless x -> endless (mul (Babs y) x).
Proof. intros H. destruct y as [[]|[]| |[] ? ? ?], H as [-> | ->]; (now left) || (now right). Qed.
Lemma endless_add x y : endless x -> endless (add x y). (* inf - inf is NaN *)
Proof. intros [-> | ->]; destruct y as [[]|[]| |[] ? ? ?]; (now left) || (now right). Qed.
Lemma add_endless x y : endless y -> endless (add x y).
Proof. intros [-> | ->]; destruct x as [[]|[]| |[] ? ? ?]; (now left) || (now right). Qed.

(** The test of [_quotient], where e_T or e_D is inf: the four lines that make E, and the last four. *)
Theorem infinite_error (first under_error high_error inverse loose left near : float) :
  Bsign loose = false ->
  under_error = B754_infinity false \/ high_error = B754_infinity false ->
  let error := mul (Babs first) under_error in
  let error := add error high_error in
  let error := mul error (Babs inverse) in
  let error := mul error loose in
  same64 (add (sub left error) near) (add (add left error) near) = false.
Proof.
  intros S [E|E]; cbv zeta; apply endless_fails, endless_mul; auto; apply endless_abs.
  - apply endless_add, abs_endless. now left.
  - apply add_endless. now left.
Qed.

(** ** e is finite *)

Section Finite.
(** [highest] masks bits away: of a finite float, as [Digits.highest] says; inf and NaN remain. *)
Variable keep : float -> float.
Hypothesis keep_value : forall x, is_finite x = true -> B2R (keep x) = highest (B2R x).
Hypothesis keep_finite : forall x, is_finite (keep x) = true -> is_finite x = true.

Definition quotient64 (high low high_error under rest under_error : float) : float * bool :=
  let inverse := add under rest in
  let inverse := Bdiv mode_NE (num 1 0) inverse in
  let first := add high low in
  let first := mul first inverse in
  let near := keep first in
  let top := keep under in
  let left := sub high (mul near top) in
  let left := sub left (mul near (sub under top)) in
  let left := add left (sub low (mul near rest)) in
  let left := mul left inverse in
  let size := Babs first in
  let error := mul size under_error in
  let error := add error high_error in
  let error := mul error (Babs inverse) in
  let error := mul error (num 4548635623644201 (-52)) in
  let least := sub left error in
  let least := add least near in
  let left := add left error in
  let left := add left near in
  (left, same64 least left && less64 (num 1 (-950)) size).

Lemma power_value k : (-1074 <= k)%Z -> is_finite (num 1 k) = true ->
  is_finite (num 1 k) = true /\ B2R (num 1 k) = pow2 k.
Proof. intros K F. split; [exact F|]. now rewrite num_value, Rmult_1_l. Qed.
Lemma least_value : is_finite (num 1 (-950)) = true /\ B2R (num 1 (-950)) = pow2 (-950).
Proof. now apply power_value. Qed.
Lemma one_value : is_finite (num 1 0) = true /\ B2R (num 1 0) = 1.
Proof. now apply (power_value 0). Qed.

(** 1 / inf is 0, and so is then the first quotient: too small. *)
Lemma inverse_value (x f : float) : is_finite (Bdiv mode_NE (num 1 0) x : float) = true ->
  less64 (num 1 (-950)) (Babs (mul f (Bdiv mode_NE (num 1 0) x))) = true -> is_finite f = true ->
  is_finite x = true /\ B2R (Bdiv mode_NE (num 1 0) x) = rnd (1 / B2R x).
Proof.
  destruct one_value as [F1 V1]. destruct least_value as [F2 V2]. unfold less64.
  generalize dependent (num 1 0). generalize dependent (num 1 (-950)).
  intros c F2 V2 one F1 V1 F L Ff. destruct (is_finite x) eqn:Fx.
  - split; [reflexivity|].
    destruct (Req_dec (B2R x) 0) as [Z|N].
    { exfalso. destruct x as [s|s| |s m e H]; try discriminate.
      - destruct one as [r|r| |r m e H]; try discriminate.
      - revert Z. simpl. intros Z. apply eq_0_F2R in Z. now destruct s. }
    generalize (Bdiv_correct prec emax _ _ mode_NE one x N). rewrite V1.
    case Rlt_bool; [intros [H _]; exact H|].
    intros H. exfalso. revert F H. generalize (Bdiv mode_NE one x).
    intros [ | | | ]; simpl; intros; discriminate.
  - exfalso. destruct x as [s|s| |s m e H]; try discriminate; [|now destruct one].
    assert (E : exists t, Babs (mul f (Bdiv mode_NE one (B754_infinity s))) = B754_zero t).
    { destruct one as [r|r| |r m e H]; try discriminate; destruct f; try discriminate; simpl; eauto. }
    destruct E as [t E]. rewrite E, Bcompare_correct, V2 in L by auto.
    revert L. rewrite Rcompare_Gt; [discriminate | apply (pow2_pos (-950))].
Qed.

Lemma same64_finite a b : same64 a b = true -> is_finite b = true -> is_finite a = true /\ B2R a = B2R b.
Proof.
  unfold same64. intros S F. assert (A : is_finite a = true).
  { destruct a as [[]|[]| |[] ? ? ?], b as [[]|[]| |[] ? ? ?]; try reflexivity; discriminate. }
  split; [exact A|]. rewrite Bcompare_correct in S by assumption.
  destruct (Rcompare_spec (B2R a) (B2R b)); [discriminate | assumption | discriminate].
Qed.

Theorem quotient64_real high low high_error under rest under_error :
  let result := quotient64 high low high_error under rest under_error in
  snd result = true -> is_finite (fst result) = true ->
  let real := quotient (B2R high) (B2R low) (B2R high_error) (B2R under) (B2R rest) (B2R under_error) in
  B2R (fst result) = fst real /\ snd real = true /\
  is_finite high = true /\ is_finite low = true /\ is_finite high_error = true /\
  is_finite under = true /\ is_finite rest = true /\ is_finite under_error = true.
Proof.
  unfold quotient64, quotient. cbv zeta. cbn [fst snd].
  set (i0 := add under rest). set (inverse := Bdiv mode_NE (num 1 0) i0).
  set (f0 := add high low). set (first := mul f0 inverse). set (near := keep first).
  set (top := keep under). set (x1 := mul near top). set (l1 := sub high x1).
  set (d2 := sub under top). set (x2 := mul near d2). set (l2 := sub l1 x2).
  set (x3 := mul near rest). set (s := sub low x3). set (l3 := add l2 s). set (left := mul l3 inverse).
  set (e1 := mul (Babs first) under_error). set (e2 := add e1 high_error).
  set (e3 := mul e2 (Babs inverse)). set (error := mul e3 (num 4548635623644201 (-52))).
  set (lower := sub left error). set (upper := add left error).
  set (least := add lower near). set (most := add upper near).
  intros H Fm. apply andb_prop in H. destruct H as [Hs Hl].
  destruct (same64_finite _ _ Hs Fm) as [Fl Es].
  destruct (plus_finite _ _ Fm) as [Fupper Fnear]. destruct (plus_finite _ _ Fupper) as [Fleft Ferror].
  destruct (plus_finite _ _ Fl) as [Flower _].
  destruct (mult_finite _ _ Fleft) as [Fl3 Finverse]. destruct (plus_finite _ _ Fl3) as [Fl2 Fs].
  destruct (minus_finite _ _ Fl2) as [Fl1 Fx2]. destruct (minus_finite _ _ Fl1) as [Fhigh Fx1].
  destruct (minus_finite _ _ Fs) as [Flow Fx3]. destruct (mult_finite _ _ Fx1) as [_ Ftop].
  destruct (mult_finite _ _ Fx2) as [_ Fd2]. destruct (mult_finite _ _ Ferror) as [Fe3 _].
  destruct (mult_finite _ _ Fe3) as [Fe2 _]. destruct (plus_finite _ _ Fe2) as [Fe1 _].
  assert (Ffirst := keep_finite _ Fnear). assert (Funder := keep_finite _ Ftop).
  destruct (mult_finite _ _ Ffirst) as [Ff0 _].
  destruct (inverse_value i0 f0 Finverse Hl Ff0) as [Fi0 Vi]. fold inverse in Vi.
  assert (Vloose : B2R (num 4548635623644201 (-52)) = 4548635623644201 * pow2 (-52)) by now apply num_value.
  destruct least_value as [Fleast Vleast].
  assert (V0 := plus_value _ _ Fi0). assert (V1 := plus_value _ _ Ff0). assert (V2 := mult_value _ _ Ffirst).
  assert (V3 := keep_value _ Ffirst). assert (V4 := keep_value _ Funder).
  assert (V5 := mult_value _ _ Fx1). assert (V6 := minus_value _ _ Fl1). assert (V7 := minus_value _ _ Fd2).
  assert (V8 := mult_value _ _ Fx2). assert (V9 := minus_value _ _ Fl2). assert (V10 := mult_value _ _ Fx3).
  assert (V11 := minus_value _ _ Fs). assert (V12 := plus_value _ _ Fl3). assert (V13 := mult_value _ _ Fleft).
  assert (V14 := mult_value _ _ Fe1). assert (V15 := plus_value _ _ Fe2). assert (V16 := mult_value _ _ Fe3).
  assert (V17 := mult_value _ _ Ferror). assert (V18 := minus_value _ _ Flower).
  assert (V19 := plus_value _ _ Fupper). assert (V20 := plus_value _ _ Fl). assert (V21 := plus_value _ _ Fm).
  fold i0 in V0. fold f0 in V1. fold first in V2. fold near in V3. fold top in V4. fold x1 in V5.
  fold l1 in V6. fold d2 in V7. fold x2 in V8. fold l2 in V9. fold x3 in V10. fold s in V11. fold l3 in V12.
  fold left in V13. fold e1 in V14. fold e2 in V15. fold e3 in V16. fold error in V17. fold lower in V18.
  fold upper in V19. fold least in V20. fold most in V21.
  rewrite B2R_Babs in V14, V16. rewrite Vloose in V17. unfold less64 in Hl.
  assert (FA : is_finite (Babs first) = true) by (rewrite is_finite_Babs; exact Ffirst).
  rewrite (Bcompare_correct _ _ _ _ Fleast FA), B2R_Babs, Vleast in Hl.
  rewrite <- V0, <- Vi, <- V1, <- V2, <- V3, <- V4, <- V5, <- V6, <- V7, <- V8, <- V9, <- V10, <- V11, <- V12,
    <- V13, <- V14, <- V15, <- V16, <- V17, <- V18, <- V19, <- V20, <- V21.
  assert (Inputs : is_finite high_error = true /\ is_finite rest = true /\ is_finite under_error = true).
  { split; [apply (plus_finite _ _ Fe2)|]. split; [apply (mult_finite _ _ Fx3) | apply (mult_finite _ _ Fe1)]. }
  split; [reflexivity|]. split; [|repeat split; tauto]. rewrite Es, Req_bool_true by reflexivity. simpl. apply Rlt_bool_true.
  destruct (Rcompare_spec (pow2 (-950)) (Rabs (B2R first))); [assumption | discriminate | discriminate].
Qed.
End Finite.

(** ** [_error]: finite only in range, and then what the real numbers say *)

Definition error64 (unit size : float) : float :=
  let error := mul unit size in
  if less64 (num 1 (-950)) error && less64 error (num 1 1000) then mul error (num 1 (-72))
  else B754_infinity false.

Lemma less64_value a b : is_finite a = true -> is_finite b = true -> less64 a b = true -> B2R a < B2R b.
Proof.
  unfold less64. intros A B. rewrite (Bcompare_correct _ _ _ _ A B).
  destruct (Rcompare_spec (B2R a) (B2R b)); [auto | discriminate | discriminate].
Qed.

Theorem error64_real unit size : is_finite (error64 unit size) = true ->
  in_range (B2R unit) (B2R size) /\ B2R (error64 unit size) = error_of (B2R unit) (B2R size).
Proof.
  unfold error64, in_range, error_of. cbv zeta.
  destruct least_value as [F1 V1]. destruct (power_value 1000) as [F2 V2]; [easy..|].
  destruct (power_value (-72)) as [F3 V3]; [easy..|]. rewrite <- V1, <- V2, <- V3. clear V1 V2 V3.
  generalize dependent (num 1 (-950)). generalize dependent (num 1 1000). generalize dependent (num 1 (-72)).
  intros s F3 m F2 l F1. destruct (less64 l (mul unit size)) eqn:L1; [|discriminate].
  destruct (less64 (mul unit size) m) eqn:L2; [|discriminate]. cbn [andb]. intros F.
  destruct (mult_finite _ _ F) as [Fe _]. rewrite (mult_value _ _ F), (mult_value _ _ Fe).
  split; [|reflexivity]. rewrite <- (mult_value _ _ Fe). split; now apply less64_value.
Qed.
