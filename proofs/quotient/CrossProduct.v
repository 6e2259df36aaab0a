(** Powers of two above vectors, the halves of normals, and cross products, as in [quotient.py]. *)
Require Import ZArith Reals Psatz Bool.
From Reftrace Require Import Trees Rounding Digits ScalarProduct.
From Flocq Require Import Core.
Open Scope R_scope.

(** ** power_above: the exponent's bits alone, doubled; 0 of what is less than 2^-1022 *)

Definition largest (v : vec) : R := Rmax (Rmax (Rabs (px v)) (Rabs (py v))) (Rabs (pz v)).
Definition exponent (s : R) : R := round radix2 (FLT_exp (-1022) 1) Ztrunc s.
Lemma exponent_keep v x : fl v (Keep 1 (Abs x)) = exponent (Rabs (fl v x)). Proof. reflexivity. Qed.
Definition power_above (v : vec) : R := rnd (exponent (largest v) * 2).

Lemma exponent_spec s : 0 <= s ->
  (s < pow2 (-1022) /\ exponent s = 0) \/
  (exists k : Z, (-1021 <= k)%Z /\ exponent s = pow2 (k - 1) /\ pow2 (k - 1) <= s < pow2 k).
Proof.
  intros P. assert (V : Valid_exp (FLT_exp (-1022) 1)) by (apply FLT_exp_valid; reflexivity).
  assert (M : multiple (cexp radix2 (FLT_exp (-1022) 1) s) (exponent s)).
  { now exists (Ztrunc (scaled_mantissa radix2 (FLT_exp (-1022) 1) s)). }
  assert (L : 0 <= exponent s <= s).
  { unfold exponent. rewrite round_ZR_DN by exact P. split.
    - apply round_ge_generic; auto using valid_rnd_DN, generic_format_0.
    - apply round_DN_pt. exact V. }
  destruct (Rlt_or_le s (pow2 (-1022))) as [H|H].
  - left. split; [exact H|]. apply (multiple_small (-1022)).
    + eapply multiple_le; [|exact M]. apply Z.le_max_r.
    + rewrite Rabs_pos_eq; lra.
  - right. exists (mag radix2 s). assert (N : s <> 0) by (generalize (pow2_pos (-1022)); lra).
    assert (K : (-1021 <= mag radix2 s)%Z) by (apply mag_ge_bpow; now rewrite Rabs_pos_eq by lra).
    assert (B1 := bpow_mag_le radix2 s N). assert (B2 := bpow_mag_gt radix2 s).
    rewrite (Rabs_pos_eq s) in B1, B2 by lra.
    split; [exact K|]. split; [|now split].
    assert (C : cexp radix2 (FLT_exp (-1022) 1) s = (mag radix2 s - 1)%Z) by (unfold cexp, FLT_exp; lia).
    rewrite C in M.
    assert (G : pow2 (mag radix2 s - 1) <= exponent s).
    { unfold exponent. apply round_ge_generic; auto using valid_rnd_ZR.
      apply generic_format_FLT_bpow; [reflexivity | lia]. }
    assert (Z : exponent s - pow2 (mag radix2 s - 1) = 0); [|lra].
    apply (multiple_small (mag radix2 s - 1)).
    + apply multiple_sub; [exact M|]. exists 1%Z. now rewrite Rmult_1_l.
    + rewrite pow2_half in *. rewrite Rabs_pos_eq; lra.
Qed.

Definition within (b : R) (v : vec) : Prop := Rabs (px v) <= b /\ Rabs (py v) <= b /\ Rabs (pz v) <= b.
Lemma largest_within v b : largest v <= b -> within b v.
Proof.
  intros H. assert (H1 := Rmax_l (Rmax (Rabs (px v)) (Rabs (py v))) (Rabs (pz v))).
  assert (H2 := Rmax_r (Rmax (Rabs (px v)) (Rabs (py v))) (Rabs (pz v))).
  assert (H3 := Rmax_l (Rabs (px v)) (Rabs (py v))). assert (H4 := Rmax_r (Rabs (px v)) (Rabs (py v))).
  unfold largest in H. repeat split; lra.
Qed.

Theorem power_above_spec v :
  (power_above v = 0 /\ within (pow2 (-1022)) v) \/
  (exists k : Z, (-1021 <= k)%Z /\ power_above v = pow2 k /\ within (pow2 k) v).
Proof.
  assert (P : 0 <= largest v) by (eapply Rle_trans; [apply Rabs_pos | apply Rmax_r]).
  unfold power_above. destruct (exponent_spec _ P) as [[L ->]|[k [K [-> L]]]].
  - left. rewrite Rmult_0_l, rnd_0. split; [reflexivity|]. apply largest_within. lra.
  - right. exists k. split; [exact K|]. split; [|apply largest_within; lra].
    rewrite pow2_half. replace (/ 2 * pow2 k * 2) with (pow2 k) by field.
    apply rnd_id, float_pow2. lia.
Qed.

(** What two_sum leaves: a float and a rest of at most u of them; the rest may be 0. *)
Definition pair (v r : R) : Prop := is_float v /\ is_float r /\ Rabs r <= U * Rabs (v + r).

Lemma pair_two_sum a b : is_float a -> is_float b -> pair (fst (two_sum a b)) (snd (two_sum a b)).
Proof.
  intros A B. destruct (two_sum_float a b) as [F G]. split; [exact F|]. split; [exact G|].
  rewrite two_sum_exact by assumption. generalize (two_sum_rest a b A B). now rewrite u_U.
Qed.
Lemma pair_0 v : is_float v -> pair v 0.
Proof.
  intros F. split; [exact F|]. split; [apply generic_format_0|]. rewrite Rabs_R0.
  generalize (Rabs_pos (v + 0)). lra.
Qed.
Lemma pair_fits k v r : pair v r -> Rabs v <= pow2 k -> fits k v r.
Proof.
  intros [F [G H]] B. repeat split; auto.
  assert (T : Rabs (v + r) <= Rabs v + Rabs r) by apply Rabs_triang. generalize (Rabs_pos v) (pow2_pos k). lra.
Qed.
Lemma pairs_fit k v r : each pair v r -> within (pow2 k) v -> each (fits k) v r.
Proof. intros [A [B C]] [X [Y Z]]. split; [|split]; now apply pair_fits. Qed.

(** ** The halves of normals, in [_enter] *)

Definition map2 (f : R -> R -> R) (v w : vec) : vec := Vec (f (px v) (px w)) (f (py v) (py w)) (f (pz v) (pz w)).
Definition high_half (unit : R) (v : vec) : vec := map2 (fun x _ => fst (halves x unit)) v v.
Definition low_half (unit : R) (v rest : vec) : vec := map2 (fun x r => rnd (snd (halves x unit) + r)) v rest.

Lemma halves_0 v : is_float v -> halves v 0 = (v, 0).
Proof.
  intros F. unfold halves.
  now rewrite Rmult_0_l, rnd_0, Rplus_0_r, (rnd_id v F), Rminus_0_r, (rnd_id v F), Rminus_diag_eq, rnd_0.
Qed.

Lemma tiny_split v r : fits (-1022) v r -> split (-1022) v r v (rnd (0 + r)).
Proof.
  intros [F [G [B C]]]. rewrite Rplus_0_l, (rnd_id r G). unfold split.
  replace (v + r - v) with r by ring. rewrite Rminus_diag_eq, Rabs_R0 by reflexivity.
  assert (P := pow2_pos (-1022)). repeat split; auto; lra.
Qed.

Theorem enter_prepared n m : each pair n m ->
  exists b : Z, prepared b n m (high_half (power_above n) n) (low_half (power_above n) n m) /\
    ((-1021 <= b)%Z /\ power_above n = pow2 b /\ tidy b (high_half (power_above n) n) \/
     b = (-1022)%Z /\ power_above n = 0).
Proof.
  intros E. destruct (power_above_spec n) as [[-> W]|[k [K [-> W]]]].
  - exists (-1022)%Z. split; [|now right]. destruct (pairs_fit _ _ _ E W) as [A [B C]].
    unfold prepared, high_half, low_half, map2. cbn [px py pz].
    rewrite !halves_0 by (apply A || apply B || apply C). cbn [fst snd].
    split; [|split]; now apply tiny_split.
  - exists k. destruct (pairs_fit _ _ _ E W) as [A [B C]].
    destruct (halves_split _ _ _ A ltac:(lia)) as [A1 A2].
    destruct (halves_split _ _ _ B ltac:(lia)) as [B1 B2].
    destruct (halves_split _ _ _ C ltac:(lia)) as [C1 C2].
    split; [split; [|split]; assumption|]. left. repeat split; assumption.
Qed.

(** ** Cross products *)

Definition minor (ai aj bi bj : R) : R := rnd (rnd (ai * bj) - rnd (aj * bi)).
Definition cross (a b : vec) : vec :=
  Vec (minor (py a) (pz a) (py b) (pz b)) (minor (pz a) (px a) (pz b) (px b))
      (minor (px a) (py a) (px b) (py b)).

(** [_cross]: of u + r and v + s, two vectors and M. *)
Definition cross2 (u r v s : vec) : vec * vec * R :=
  let unit_u := power_above u in let unit_v := power_above v in
  let uh := high_half unit_u u in let ul := low_half unit_u u r in
  let vh := high_half unit_v v in let vl := low_half unit_v v s in
  let small := map2 (fun x y => rnd (x + y)) (cross uh vl) (cross ul v) in
  let n := map2 (fun x y => fst (two_sum x y)) (cross uh vh) small in
  let m := map2 (fun x y => snd (two_sum x y)) (cross uh vh) small in
  (n, m, rnd (unit_u * unit_v)).

Section Term.
Variables a b : Z.
Variables u r uh ul v s vh vl : R.
Hypothesis Su : split a u r uh ul.
Hypothesis Sv : split b v s vh vl.
Let W := pow2 a * pow2 b.

Lemma cross_terms :
  Rabs (rnd (uh * vl) - uh * (v + s - vh)) <= 201 / 100 * U * F26 * W + eta /\
  Rabs (rnd (uh * vl)) <= 101 / 100 * F26 * W + eta /\
  Rabs (rnd (ul * v) - (u + r - uh) * (v + s)) <= 401 / 100 * U * F26 * W + eta /\
  Rabs (rnd (ul * v)) <= 101 / 100 * F26 * W + eta.
Proof.
  destruct Su as [_ [_ [Bh [Bu [Bl [Br El]]]]]]. destruct Sv as [_ [_ [Ch [Cv [Cl [Cs Fl]]]]]].
  assert (WP : 0 < W) by apply W_pos. assert (EP := eta_pos).
  assert (VP := pow2_pos a). assert (NP := pow2_pos b).
  set (f0 := u + r - uh) in *. set (l0 := v + s - vh) in *.
  assert (D1 : Rabs ul <= (1 + U) * fine * pow2 a).
  { replace ul with (ul - f0 + f0) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (D2 : Rabs vl <= (1 + U) * fine * pow2 b).
  { replace vl with (vl - l0 + l0) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Bh' : Rabs uh <= 1 * pow2 a) by lra. assert (Cv' : Rabs v <= 1 * pow2 b) by lra.
  assert (Fl' : Rabs (vl - l0) <= U * fine * pow2 b) by lra.
  assert (El' : Rabs (ul - f0) <= U * fine * pow2 a) by lra.
  assert (M1 := mul_le a b uh vl _ _ Bh' D2). assert (M2 := mul_le a b uh (vl - l0) _ _ Bh' Fl').
  assert (M3 := mul_le a b ul v _ _ D1 Cv'). assert (M4 := mul_le a b (ul - f0) v _ _ El' Cv').
  assert (M5 := mul_le a b f0 s _ _ Bl Cs). fold W in M1, M2, M3, M4, M5.
  assert (Q1 := off_any _ _ M1). assert (Q2 := off_any _ _ M3).
  clearbody f0 l0. repeat split.
  - clear - Q1 M2 WP. abs.
  - clear - Q1 M1 WP. abs.
  - clear - Q2 M4 M5 WP. abs.
  - clear - Q2 M3 WP. abs.
Qed.
End Term.

(** One component: exact but for 21 u 2^-26 M (the docstring: 2^-72 M). *)
Lemma component_near a b u1 r1 u2 r2 v1 s1 v2 s2 uh1 ul1 uh2 ul2 vh1 vl1 vh2 vl2 :
  split a u1 r1 uh1 ul1 -> split a u2 r2 uh2 ul2 -> split b v1 s1 vh1 vl1 -> split b v2 s2 vh2 vl2 ->
  multiple (a - 25) uh1 -> multiple (a - 25) uh2 -> multiple (b - 25) vh1 -> multiple (b - 25) vh2 ->
  Rabs (minor uh1 uh2 vh1 vh2 + rnd (minor uh1 uh2 vl1 vl2 + minor ul1 ul2 v1 v2)
    - ((u1 + r1) * (v2 + s2) - (u2 + r2) * (v1 + s1))) <= 21 * U * F26 * (pow2 a * pow2 b) + 20 * eta.
Proof.
  intros U1 U2 V1 V2 M1 M2 M3 M4.
  destruct (cross_terms _ _ _ _ _ _ _ _ _ _ U1 V2) as [A1 [A2 [A3 A4]]].
  destruct (cross_terms _ _ _ _ _ _ _ _ _ _ U2 V1) as [B1 [B2 [B3 B4]]].
  assert (WP := W_pos a b). assert (EP := eta_pos). set (W := pow2 a * pow2 b) in *.
  assert (X : Rabs (minor uh1 uh2 vh1 vh2 - (uh1 * vh2 - uh2 * vh1)) <= 2 * eta).
  { apply (coarse_tidy a b uh1 uh2 uh1 vh2 vh1 vh2); auto; (apply U1 || apply U2 || apply V1 || apply V2). }
  assert (C1 : Rabs (rnd (uh1 * vl2) - rnd (uh2 * vl1)) <= 202 / 100 * F26 * W + 2 * eta)
    by (clear - A2 B2; abs).
  assert (C2 : Rabs (rnd (ul1 * v2) - rnd (ul2 * v1)) <= 202 / 100 * F26 * W + 2 * eta)
    by (clear - A4 B4; abs).
  assert (Q1 := off_diff _ _ _ (rnd_float _) (rnd_float _) C1).
  assert (Q2 := off_diff _ _ _ (rnd_float _) (rnd_float _) C2).
  unfold minor in *. set (p := rnd (rnd (uh1 * vl2) - rnd (uh2 * vl1))) in *.
  set (q := rnd (rnd (ul1 * v2) - rnd (ul2 * v1))) in *.
  assert (C3 : Rabs (p + q) <= 405 / 100 * F26 * W + 5 * eta) by (clear - C1 C2 Q1 Q2 WP EP; abs).
  assert (Q3 := off_sum p q _ (rnd_float _) (rnd_float _) C3).
  clear - X Q1 Q2 Q3 A1 A3 B1 B3 WP EP. abs.
Qed.

Definition exact_cross (a b : vec) : vec :=
  Vec (py a * pz b - pz a * py b) (pz a * px b - px a * pz b) (px a * py b - py a * px b).

(** What is known of a plane: its normal as a float and a rest, and how far off they are. M is 0
    where the normal is given, and never tiny (the code has inf instead, see [Overflow.v]). *)
Definition known (normal n m : vec) (M : R) : Prop :=
  each pair n m /\ (M = 0 \/ pow2 (-950) < M) /\ is_float M /\
  within (pow2 (-74) * M) (map2 Rminus (vadd n m) normal).

Theorem cross_known u r v s : each pair u r -> each pair v s ->
  let '(n, m, M) := cross2 u r v s in
  pow2 (-950) < M -> known (exact_cross (vadd u r) (vadd v s)) n m M.
Proof.
  intros PU PV. unfold cross2. intros L. split; [|split; [now right|split; [apply rnd_float|]]].
  { split; [|split]; apply pair_two_sum; apply rnd_float. }
  assert (L0 := pow2_pos (-950)).
  destruct (power_above_spec u) as [[E _]|[a [A [E WU]]]].
  { exfalso. revert L. rewrite E, Rmult_0_l, rnd_0. lra. }
  destruct (power_above_spec v) as [[F _]|[b [B [F WV]]]].
  { exfalso. revert L. rewrite F, Rmult_0_r, rnd_0. lra. }
  assert (M : rnd (power_above u * power_above v) = pow2 a * pow2 b).
  { rewrite E, F, <- bpow_plus. apply rnd_id, float_pow2.
    destruct (Z_le_gt_dec (-1074) (a + b)) as [H|H]; [exact H|]. exfalso.
    revert L. rewrite E, F, <- bpow_plus. apply Rle_not_lt. rewrite <- (rnd_id (pow2 (-950))) by now apply float_pow2.
    apply rnd_le, pow2_le. lia. }
  rewrite M in *.
  assert (N := eta_le (-950) _ ltac:(lia) (Rlt_le _ _ L)).
  change (pow2 (-1075 - -950)) with (/ 42535295865117307932921825928971026432) in N.
  change (pow2 (-74)) with (/ 18889465931478580854784).
  destruct (pairs_fit _ _ _ PU WU) as [U1 [U2 U3]]. destruct (pairs_fit _ _ _ PV WV) as [V1 [V2 V3]].
  assert (A' : (-1049 <= a)%Z) by lia. assert (B' : (-1049 <= b)%Z) by lia.
  destruct (halves_split _ _ _ U1 A') as [SU1 MU1]. destruct (halves_split _ _ _ U2 A') as [SU2 MU2].
  destruct (halves_split _ _ _ U3 A') as [SU3 MU3]. destruct (halves_split _ _ _ V1 B') as [SV1 MV1].
  destruct (halves_split _ _ _ V2 B') as [SV2 MV2]. destruct (halves_split _ _ _ V3 B') as [SV3 MV3].
  rewrite <- E in SU1, SU2, SU3, MU1, MU2, MU3. rewrite <- F in SV1, SV2, SV3, MV1, MV2, MV3.
  unfold within, map2, vadd, exact_cross, cross, high_half, low_half. cbn [px py pz].
  rewrite !two_sum_exact by apply rnd_float.
  assert (WP := W_pos a b). set (W := pow2 a * pow2 b) in *.
  split; [|split].
  - eapply Rle_trans; [apply (component_near a b _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ SU2 SU3 SV2 SV3 MU2 MU3 MV2 MV3)|].
    fold W. clear - N WP. lra.
  - eapply Rle_trans; [apply (component_near a b _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ SU3 SU1 SV3 SV1 MU3 MU1 MV3 MV1)|].
    fold W. clear - N WP. lra.
  - eapply Rle_trans; [apply (component_near a b _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ _ SU1 SU2 SV1 SV2 MU1 MU2 MV1 MV2)|].
    fold W. clear - N WP. lra.
Qed.
