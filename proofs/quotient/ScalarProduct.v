(** Scalar and cross products of vectors in halves, as [quotient.py] computes them, and their errors.

    V = 2^a and N = 2^b are the powers of two above what is multiplied. A float v comes with a rest
    (of [two_sum], or 0): v + rest is what is meant, and the rest is at most 2 u V. *)
Require Import ZArith Reals Psatz Bool.
From Reftrace Require Import Trees Rounding Digits.
From Flocq Require Import Core.
Open Scope R_scope.

(** The rest after the high half: |low| <= [fine] V, with the rest of two_sum. *)
Notation fine := (/ 67108864 + 2 * U).
Notation F26 := (/ 67108864).

Definition fits (k : Z) (v rest : R) : Prop :=
  is_float v /\ is_float rest /\ Rabs v <= pow2 k /\ Rabs rest <= 2 * U * pow2 k.

(** In halves: a high half c of 25 digits (or, of a normal that is tiny, whatever), and the rest. *)
Definition split (k : Z) (v rest high low : R) : Prop :=
  is_float high /\ is_float low /\ Rabs high <= pow2 k /\ Rabs v <= pow2 k /\
  Rabs (v + rest - high) <= fine * pow2 k /\ Rabs rest <= 2 * U * pow2 k /\
  Rabs (low - (v + rest - high)) <= U * (fine * pow2 k).

Lemma halves_split k v rest : fits k v rest -> (-1049 <= k)%Z ->
  let high := fst (halves v (pow2 k)) in let low := snd (halves v (pow2 k)) in
  split k v rest high (rnd (low + rest)) /\ multiple (k - 25) high.
Proof.
  intros [F [G [B C]]] K. generalize (halves_exact k v F B K). destruct (halves v (pow2 k)) as [h l].
  intros [M [H [E [L [FH FL]]]]]. simpl. split; [|exact M].
  replace (k - 26)%Z with (-26 + k)%Z in L by ring. rewrite bpow_plus in L.
  change (pow2 (-26)) with F26 in L.
  assert (Q : Rabs (l + rest) <= fine * pow2 k).
  { eapply Rle_trans; [apply Rabs_triang|]. lra. }
  replace (v + rest - h) with (l + rest) by lra.
  unfold split. replace (v + rest - h) with (l + rest) by lra.
  repeat split; auto; [apply rnd_float | now apply off_sum].
Qed.

(** ** A product of what is in halves, but for that of the high halves *)

Section Term.
Variables a b : Z.
Variables v r c f n m h l : R.
Hypothesis Sv : split a v r c f.
Hypothesis Sn : split b n m h l.
Let W := pow2 a * pow2 b.

Lemma mul_le x y p q : Rabs x <= p * pow2 a -> Rabs y <= q * pow2 b -> Rabs (x * y) <= p * q * W.
Proof.
  intros X Y. rewrite Rabs_mult. unfold W.
  replace (p * q * (pow2 a * pow2 b)) with (p * pow2 a * (q * pow2 b)) by ring.
  apply Rmult_le_compat; auto using Rabs_pos.
Qed.

Lemma W_pos : 0 < W. Proof. apply Rmult_lt_0_compat; apply pow2_pos. Qed.

(** In [_dot]: low * coarse + (high + low) * fine. *)
Definition term := rnd (rnd (l * c) + rnd (rnd (h + l) * f)).

Lemma term_near : Rabs (term - ((v + r) * (n + m) - c * h)) <= 701 / 100 * U * F26 * W + 3 * eta /\
  Rabs term <= 201 / 100 * F26 * W + 3 * eta.
Proof.
  destruct Sv as [Fc [Ff [Bc [Bv [Bf [Br Ef]]]]]]. destruct Sn as [Fh [Fl [Bh [Bn [Bl [Bm El]]]]]].
  assert (WP := W_pos). assert (EP := eta_pos). assert (VP := pow2_pos a). assert (NP := pow2_pos b).
  set (f0 := v + r - c) in *. set (l0 := n + m - h) in *.
  assert (Cf : Rabs f <= (1 + U) * fine * pow2 a).
  { replace f with (f - f0 + f0) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Cl : Rabs l <= (1 + U) * fine * pow2 b).
  { replace l with (l - l0 + l0) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Bnm : Rabs (n + m) <= (1 + 2 * U) * pow2 b).
  { eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Bhl : Rabs (h + l) <= (1 + 3 * U) * pow2 b).
  { replace (h + l) with (n + m + (l - l0)) by (unfold l0; ring).
    eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Q1 := off_sum h l _ Fh Fl Bhl). set (s := rnd (h + l)) in *.
  assert (Es : Rabs (s - (n + m)) <= U * (1 + / 16777216) * pow2 b).
  { replace (s - (n + m)) with (s - (h + l) + (l - l0)) by (unfold l0; ring).
    eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Bs : Rabs s <= (1 + / 16777216) * pow2 b).
  { replace s with (s - (n + m) + (n + m)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Bc' : Rabs c <= 1 * pow2 a) by lra.
  assert (M1 := mul_le c l _ _ Bc' Cl).
  assert (El' : Rabs (l - l0) <= U * fine * pow2 b) by lra.
  assert (M2 := mul_le c (l - l0) _ _ Bc' El').
  assert (M3 := mul_le f s _ _ Cf Bs).
  assert (M4 := mul_le f (s - (n + m)) _ _ Cf Es).
  assert (Ef' : Rabs (f - f0) <= U * fine * pow2 a) by lra.
  assert (M5 := mul_le (f - f0) (n + m) _ _ Ef' Bnm).
  rewrite Rmult_comm in M1, M3.
  assert (Q2 := off_any _ _ M1). assert (Q3 := off_any _ _ M3).
  assert (B4 : Rabs (rnd (l * c) + rnd (s * f)) <= (2 + / 1048576) * F26 * W + 2 * eta).
  { clear - Q2 Q3 M1 M3 WP EP. abs. }
  assert (Q4 := off_sum _ _ _ (rnd_float (l * c)) (rnd_float (s * f)) B4). fold term in Q4.
  assert (X : (v + r) * (n + m) - c * h = c * l0 + f0 * (n + m)) by (unfold l0, f0; ring).
  rewrite X. clearbody f0 l0. split.
  - clear - Q2 Q3 Q4 M2 M4 M5 WP EP. unfold term in *. fold s in Q4 |- *. abs.
  - clear - Q4 B4 WP EP. unfold term in *. fold s in Q4 |- *. abs.
Qed.
End Term.

(** ** [_dot] *)

Record vec := Vec { px : R; py : R; pz : R }.
Definition inner (v w : vec) : R := px v * px w + py v * py w + pz v * pz w.
Definition vadd (v w : vec) : vec := Vec (px v + px w) (py v + py w) (pz v + pz w).
Definition each (P : R -> R -> Prop) (v w : vec) : Prop :=
  P (px v) (px w) /\ P (py v) (py w) /\ P (pz v) (pz w).

Definition dot (v rest : vec) (unit : R) (high low : vec) : R * R :=
  let half v := halves v unit in
  let c1 := fst (half (px v)) in let c2 := fst (half (py v)) in let c3 := fst (half (pz v)) in
  let f1 := rnd (snd (half (px v)) + px rest) in
  let f2 := rnd (snd (half (py v)) + py rest) in
  let f3 := rnd (snd (half (pz v)) + pz rest) in
  let x := rnd (rnd (c1 * px high) + rnd (c2 * py high)) in
  let x := rnd (x + rnd (c3 * pz high)) in
  let s1 := rnd (rnd (px low * c1) + rnd (rnd (px high + px low) * f1)) in
  let s2 := rnd (rnd (py low * c2) + rnd (rnd (py high + py low) * f2)) in
  let s3 := rnd (rnd (pz low * c3) + rnd (rnd (pz high + pz low) * f3)) in
  (x, rnd (rnd (s1 + s2) + s3)).

(** The prepared halves of a normal: of 25 digits, or tiny (its power_above is 0, the rest is 0). *)
Definition prepared (b : Z) (n m high low : vec) : Prop :=
  split b (px n) (px m) (px high) (px low) /\ split b (py n) (py m) (py high) (py low) /\
  split b (pz n) (pz m) (pz high) (pz low).
Definition tidy (b : Z) (high : vec) : Prop :=
  multiple (b - 25) (px high) /\ multiple (b - 25) (py high) /\ multiple (b - 25) (pz high).

(** The sum of the high halves' products: exact, or nearly, where it underflows or a normal is tiny. *)
Lemma tiny_sum x y : is_float x -> is_float y -> Rabs (x + y) <= pow2 (-1021) -> rnd (x + y) = x + y.
Proof.
  intros H K B. apply rnd_id, (multiple_float (-1074)); [|exact B|lia].
  apply multiple_add; now apply float_multiple_min.
Qed.

Lemma coarse_tidy a b x y z x' y' z' :
  multiple (a - 25) x -> multiple (a - 25) y -> multiple (a - 25) z ->
  multiple (b - 25) x' -> multiple (b - 25) y' -> multiple (b - 25) z' ->
  Rabs x <= pow2 a -> Rabs y <= pow2 a -> Rabs z <= pow2 a ->
  Rabs x' <= pow2 b -> Rabs y' <= pow2 b -> Rabs z' <= pow2 b ->
  Rabs (rnd (rnd (rnd (x * x') + rnd (y * y')) + rnd (z * z')) - (x * x' + y * y' + z * z')) <= 3 * eta /\
  Rabs (rnd (rnd (x * x') - rnd (y * y')) - (x * x' - y * y')) <= 2 * eta.
Proof.
  intros M1 M2 M3 M4 M5 M6 B1 B2 B3 B4 B5 B6. assert (E := eta_pos).
  destruct (Z_le_gt_dec (-1024) (a + b)) as [L|L].
  - destruct (products_exact a b x y z x' y' z') as [-> ->]; auto.
    rewrite !Rminus_diag_eq, !Rabs_R0 by reflexivity. lra.
  - assert (T : 8 * pow2 (-1024) = pow2 (-1021)) by (change 8 with (pow2 3); now rewrite <- bpow_plus).
    assert (L' : pow2 (a + b) <= pow2 (-1024)) by (apply pow2_le; lia).
    assert (T0 := pow2_pos (-1074)).
    assert (E1 : eta = / 2 * pow2 (-1074)) by reflexivity.
    assert (E2 : pow2 (-1074) <= pow2 (-1024)) by (apply pow2_le; lia).
    assert (S : forall p q, Rabs p <= pow2 a -> Rabs q <= pow2 b ->
      Rabs (p * q) <= pow2 (-1024) /\ Rabs (rnd (p * q) - p * q) <= eta).
    { intros p q P Q. assert (K : Rabs (p * q) <= pow2 (-1024)).
      { eapply Rle_trans; [|exact L']. rewrite Rabs_mult, bpow_plus.
        apply Rmult_le_compat; auto using Rabs_pos. }
      split; [exact K|]. rewrite E1, <- (pow2_half (-1074)). apply rnd_err_abs; [lia|].
      eapply Rle_trans; [exact K|]. apply pow2_le. lia. }
    destruct (S _ _ B1 B4) as [S1 R1]. destruct (S _ _ B2 B5) as [S2 R2].
    destruct (S _ _ B3 B6) as [S3 R3].
    assert (N1 : rnd (rnd (x * x') + rnd (y * y')) = rnd (x * x') + rnd (y * y')).
    { apply tiny_sum; try apply rnd_float. rewrite <- T. clear - S1 S2 R1 R2 E1 E2 T0. abs. }
    split.
    + rewrite N1, tiny_sum; try apply rnd_float; [clear - R1 R2 R3; abs| |].
      * rewrite <- N1. apply rnd_float.
      * rewrite <- T. clear - S1 S2 S3 R1 R2 R3 E1 E2 T0. abs.
    + unfold Rminus at 1 2. rewrite <- (Ropp_involutive (- rnd (y * y'))), Ropp_involutive, <- rnd_opp.
      rewrite tiny_sum; try apply rnd_float; rewrite rnd_opp; [clear - R1 R2; abs|].
      rewrite <- T. clear - S1 S2 R1 R2 E1 E2 T0. abs.
Qed.

Lemma coarse_any x y z p q r w : Rabs (x * p) <= w -> Rabs (y * q) <= w -> Rabs (z * r) <= w ->
  Rabs (rnd (rnd (rnd (x * p) + rnd (y * q)) + rnd (z * r)) - (x * p + y * q + z * r))
    <= 9 * U * w + 4 * eta.
Proof.
  intros H1 H2 H3. assert (E := eta_pos).
  assert (Q1 := off_any _ _ H1). assert (Q2 := off_any _ _ H2). assert (Q3 := off_any _ _ H3).
  assert (B4 : Rabs (rnd (x * p) + rnd (y * q)) <= (2 + 2 * U) * w + 2 * eta) by (clear - Q1 Q2 H1 H2; abs).
  assert (Q4 := off_sum _ _ _ (rnd_float _) (rnd_float _) B4).
  assert (B5 : Rabs (rnd (rnd (x * p) + rnd (y * q)) + rnd (z * r)) <= (3 + 9 * U) * w + 4 * eta).
  { clear - Q3 Q4 B4 H3 E H1. abs. }
  assert (Q5 := off_sum _ _ _ (rnd_float _) (rnd_float _) B5).
  clear - Q1 Q2 Q3 Q4 Q5 E H1. abs.
Qed.

(** v . n, of v = v + rest and n = n + m: the two floats' sum is that but for [32 u 2^-26 V N]. *)
Theorem dot_near a b v rest n m high low :
  each (fits a) v rest -> (-1049 <= a)%Z -> prepared b n m high low ->
  let W := pow2 a * pow2 b in
  let x := fst (dot v rest (pow2 a) high low) in
  let small := snd (dot v rest (pow2 a) high low) in
  is_float x /\ is_float small /\ Rabs small <= 7 * F26 * W + 20 * eta /\
  Rabs (x + small) <= 7 / 2 * W + 40 * eta /\
  (tidy b high -> Rabs (x + small - inner (vadd v rest) (vadd n m)) <= 32 * U * F26 * W + 20 * eta) /\
  Rabs (x + small - inner (vadd v rest) (vadd n m)) <= 10 * U * W + 20 * eta.
Proof.
  intros [V1 [V2 V3]] K [P1 [P2 P3]]. unfold dot.
  destruct (halves_split _ _ _ V1 K) as [S1 M1]. destruct (halves_split _ _ _ V2 K) as [S2 M2].
  destruct (halves_split _ _ _ V3 K) as [S3 M3].
  destruct (term_near _ _ _ _ _ _ _ _ _ _ S1 P1) as [T1 U1].
  destruct (term_near _ _ _ _ _ _ _ _ _ _ S2 P2) as [T2 U2].
  destruct (term_near _ _ _ _ _ _ _ _ _ _ S3 P3) as [T3 U3]. unfold term in *.
  assert (WP := W_pos a b). assert (EP := eta_pos).
  set (c1 := fst (halves (px v) (pow2 a))) in *. set (c2 := fst (halves (py v) (pow2 a))) in *.
  set (c3 := fst (halves (pz v) (pow2 a))) in *.
  set (f1 := snd (halves (px v) (pow2 a))) in *. set (f2 := snd (halves (py v) (pow2 a))) in *.
  set (f3 := snd (halves (pz v) (pow2 a))) in *.
  set (t1 := rnd (rnd (px low * c1) + _)) in *. set (t2 := rnd (rnd (py low * c2) + _)) in *.
  set (t3 := rnd (rnd (pz low * c3) + _)) in *. set (W := pow2 a * pow2 b) in *.
  cbv zeta. unfold fst, snd. fold c1 c2 c3 f1 f2 f3 t1 t2 t3.
  destruct S1 as [_ [_ [C1 _]]]. destruct S2 as [_ [_ [C2 _]]]. destruct S3 as [_ [_ [C3 _]]].
  destruct P1 as [_ [_ [H1 _]]]. destruct P2 as [_ [_ [H2 _]]]. destruct P3 as [_ [_ [H3 _]]].
  assert (Z1 : Rabs (c1 * px high) <= W) by (rewrite Rabs_mult; apply Rmult_le_compat; auto using Rabs_pos).
  assert (Z2 : Rabs (c2 * py high) <= W) by (rewrite Rabs_mult; apply Rmult_le_compat; auto using Rabs_pos).
  assert (Z3 : Rabs (c3 * pz high) <= W) by (rewrite Rabs_mult; apply Rmult_le_compat; auto using Rabs_pos).
  assert (X := coarse_any _ _ _ _ _ _ _ Z1 Z2 Z3).
  assert (X' : tidy b high -> Rabs (rnd (rnd (rnd (c1 * px high) + rnd (c2 * py high)) + rnd (c3 * pz high))
    - (c1 * px high + c2 * py high + c3 * pz high)) <= 3 * eta).
  { intros [D1 [D2 D3]]. now apply (coarse_tidy a b). }
  set (x := rnd (rnd (rnd (c1 * px high) + _) + _)) in *.
  assert (B1 : Rabs (t1 + t2) <= 402 / 100 * F26 * W + 6 * eta) by (clear - U1 U2; abs).
  assert (Q1 : Rabs (rnd (t1 + t2) - (t1 + t2)) <= U * (402 / 100 * F26 * W + 6 * eta))
    by (apply off_sum; auto; apply rnd_float).
  assert (B2 : Rabs (rnd (t1 + t2) + t3) <= 604 / 100 * F26 * W + 10 * eta) by (clear - B1 Q1 U3 WP EP; abs).
  assert (Q2 : Rabs (rnd (rnd (t1 + t2) + t3) - (rnd (t1 + t2) + t3)) <= U * (604 / 100 * F26 * W + 10 * eta))
    by (apply off_sum; auto; apply rnd_float).
  set (s := rnd (rnd (t1 + t2) + t3)) in *.
  set (e1 := (px v + px rest) * (px n + px m)) in *. set (e2 := (py v + py rest) * (py n + py m)) in *.
  set (e3 := (pz v + pz rest) * (pz n + pz m)) in *.
  assert (I : inner (vadd v rest) (vadd n m) = e1 + e2 + e3) by reflexivity. rewrite I.
  assert (S : Rabs (s - (e1 + e2 + e3 - (c1 * px high + c2 * py high + c3 * pz high)))
    <= 3199 / 100 * U * F26 * W + 10 * eta) by (clear - T1 T2 T3 Q1 Q2 WP EP; abs).
  repeat split; try apply rnd_float.
  - clear - B2 Q2 WP EP. abs.
  - clear - B2 Q2 WP EP X Z1 Z2 Z3. abs.
  - intros D. specialize (X' D). clear - S X' WP EP. abs.
  - clear - S X WP EP. abs.
Qed.
