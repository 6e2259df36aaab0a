(** [Quotients.meet]: where its second result is True, the first is t = T / D, rounded once.

    T = (p - o) . n and D = d . n, of the exact normal n: (b - a) x (c - a) of a triangle (see
    [cross_known]), or one that is given. Three cases, as [_enter] and [meet] have them: rays that
    share their origin, their direction, or nothing. All in real numbers, rounded as if there were
    no largest float (why that is enough for [_quotient] and [_error]: [Overflow.v]); [in_range] is
    what [_error] asks for before it returns something finite. *)
Require Import ZArith Reals Psatz Bool.
From Reftrace Require Import Trees Rounding Digits ScalarProduct CrossProduct Ziv.
From Flocq Require Import Core.
Open Scope R_scope.

(** [_error], where it is finite: [in_range] is its condition. *)
Definition error_of (unit size : R) : R := rnd (rnd (unit * size) * pow2 (-72)).
Definition in_range (unit size : R) : Prop := pow2 (-950) < rnd (unit * size) < pow2 1000.
(** N + 3 M *)
Definition size_of (n : vec) (M : R) : R := rnd (power_above n + rnd (3 * M)).

Lemma relative x : pow2 (-1022) <= x -> (1 - U) * x <= rnd x <= (1 + U) * x.
Proof.
  intros H. assert (P := pow2_pos (-1022)). assert (Q := rnd_err_rel x). rewrite Rabs_pos_eq, u_U in Q by lra.
  apply Rabs_le_inv in Q; lra.
Qed.

Lemma error_of_bounds a n m M exact : known exact n m M -> in_range (pow2 a) (size_of n M) ->
  let G := pow2 a * (power_above n + 3 * M) in
  pow2 (-951) <= G /\ G <= 2 * pow2 1000 /\ pow2 (-1022) <= error_of (pow2 a) (size_of n M) /\
  (1 - 6 * U) * (/ 4722366482869645213696 * G) <= error_of (pow2 a) (size_of n M)
    <= 2 * (/ 4722366482869645213696 * G) /\ 0 <= M /\
  (power_above n = 0 -> pow2 (-950) < M).
Proof.
  intros [_ [HM [FM _]]] [L H] G. unfold error_of. set (x := rnd (pow2 a * size_of n M)) in *.
  assert (L0 := pow2_pos (-950)). assert (A := pow2_pos a).
  assert (M0 : 0 <= M) by (destruct HM; lra).
  assert (N0 : 0 <= power_above n /\ is_float (power_above n)).
  { split; [|apply rnd_float]. destruct (power_above_spec n) as [[-> _]|[k [_ [-> _]]]]; [lra | apply bpow_ge_0]. }
  assert (B3 : (1 - U) * (3 * M) <= rnd (3 * M) <= (1 + U) * (3 * M)).
  { destruct HM as [->|HM]; [rewrite Rmult_0_r, rnd_0; lra|]. apply relative.
    apply Rle_trans with (pow2 (-950)); [apply pow2_le; lia | lra]. }
  assert (Bs : Rabs (size_of n M - (power_above n + rnd (3 * M))) <= U * (power_above n + rnd (3 * M))).
  { apply off_sum; [apply N0 | apply rnd_float|]. rewrite Rabs_pos_eq; lra. }
  set (z := size_of n M) in *.
  assert (Bz : (1 - 3 * U) * (power_above n + 3 * M) <= z <= (1 + 3 * U) * (power_above n + 3 * M)).
  { clear - Bs B3 N0 M0. apply Rabs_le_inv in Bs. lra. }
  assert (Gz : (1 - 3 * U) * G <= pow2 a * z <= (1 + 3 * U) * G).
  { unfold G. split.
    - replace ((1 - 3 * U) * (pow2 a * (power_above n + 3 * M)))
        with (pow2 a * ((1 - 3 * U) * (power_above n + 3 * M))) by ring.
      apply Rmult_le_compat_l; lra.
    - replace ((1 + 3 * U) * (pow2 a * (power_above n + 3 * M)))
        with (pow2 a * ((1 + 3 * U) * (power_above n + 3 * M))) by ring.
      apply Rmult_le_compat_l; lra. }
  assert (Gl : pow2 (-950) < pow2 a * z).
  { apply Rnot_le_lt. intros K. apply rnd_le in K. fold x in K.
    rewrite (rnd_id (pow2 (-950))) in K by now apply float_pow2. lra. }
  assert (Bx : (1 - U) * (pow2 a * z) <= x <= (1 + U) * (pow2 a * z)).
  { apply relative. apply Rle_trans with (pow2 (-950)); [apply pow2_le; lia | lra]. }
  assert (C : pow2 (-950) * pow2 (-72) = pow2 (-1022)) by (now rewrite <- bpow_plus).
  assert (P72 : pow2 (-72) = / 4722366482869645213696) by reflexivity.
  assert (Be : (1 - U) * (x * pow2 (-72)) <= rnd (x * pow2 (-72)) <= (1 + U) * (x * pow2 (-72))).
  { apply relative. rewrite <- C. apply Rmult_le_compat_r; [apply bpow_ge_0 | lra]. }
  assert (H951 := pow2_half (-950)). change (-950 - 1)%Z with (-951)%Z in H951.
  split; [|split; [|split; [|split; [|split]]]].
  - lra.
  - lra.
  - rewrite <- (rnd_id (pow2 (-1022))) by now apply float_pow2. apply rnd_le. rewrite <- C.
    apply Rmult_le_compat_r; [apply bpow_ge_0 | lra].
  - rewrite P72 in *. clear - Be Bx Gz Gl L0. split; lra.
  - exact M0.
  - intros E. destruct HM as [Z|HM]; [|exact HM]. exfalso. unfold G in Gz.
    rewrite E, Z in Gz. lra.
Qed.

(** What [Ziv] asks of T, D and their e: with [w] at least V N, and room for one more rounding. *)
Definition pair_near (exact high low e w : R) : Prop :=
  is_float high /\ is_float low /\
  Rabs (exact - (high + low)) + (pow2 (-73) + 3 / 2 * pow2 (-75)) * w <= e /\
  Rabs low <= 15 / 2 * F26 * w /\ Rabs (high + low) <= 18 / 5 * w /\ pow2 (-1022) <= e /\ w <= 2 * pow2 1000 /\
  e <= U * w.

Theorem dot_known a v r exact n m M : each (fits a) v r -> (-1049 <= a)%Z -> known exact n m M ->
  in_range (pow2 a) (size_of n M) ->
  let d := dot v r (pow2 a) (high_half (power_above n) n) (low_half (power_above n) n m) in
  exists w, pair_near (inner (vadd v r) exact) (fst d) (snd d) (error_of (pow2 a) (size_of n M)) w.
Proof.
  intros FV A K R d. destruct (error_of_bounds _ _ _ _ _ K R) as [G1 [G2 [E1 [E2 [M0 M1]]]]].
  destruct K as [PN [_ [_ DN]]]. destruct (enter_prepared n m PN) as [b [PR BB]].
  destruct (dot_near a b v r n m _ _ FV A PR) as [F1 [F2 [S1 [S2 [T1 T2]]]]]. fold d in F1, F2, S1, S2, T1, T2.
  set (e := error_of _ _) in *. set (W := pow2 a * pow2 b) in *. set (VM := pow2 a * M).
  assert (AP := pow2_pos a). assert (WP : 0 < W) by apply W_pos.
  assert (VM0 : 0 <= VM) by (apply Rmult_le_pos; lra). assert (EP := eta_pos).
  exists (W + VM). set (x := fst d) in *. set (s := snd d) in *.
  (* the error of the normal *)
  assert (I : Rabs (inner (vadd v r) (vadd n m) - inner (vadd v r) exact)
    <= 3 * (1 + 2 * U) * (/ 18889465931478580854784 * VM)).
  { change (pow2 (-74)) with (/ 18889465931478580854784) in DN. destruct DN as [D1 [D2 D3]].
    unfold map2 in *. unfold inner. cbn [px py pz] in *.
    assert (B : forall p q y, fits a p q -> Rabs y <= / 18889465931478580854784 * M ->
      Rabs ((p + q) * y) <= (1 + 2 * U) * (/ 18889465931478580854784 * VM)).
    { intros p q y [_ [_ [P Q]]] Y. rewrite Rabs_mult. unfold VM.
      replace ((1 + 2 * U) * (/ 18889465931478580854784 * (pow2 a * M)))
        with ((1 + 2 * U) * pow2 a * (/ 18889465931478580854784 * M)) by ring.
      apply Rmult_le_compat; try apply Rabs_pos; [|exact Y].
      eapply Rle_trans; [apply Rabs_triang|]. lra. }
    destruct FV as [V1 [V2 V3]].
    assert (B1 := B _ _ _ V1 D1). assert (B2 := B _ _ _ V2 D2). assert (B3 := B _ _ _ V3 D3).
    clear - B1 B2 B3. unfold vadd in *. cbn [px py pz] in *. abs. }
  (* V N, and the error of the sums *)
  assert (H : Rabs (x + s - inner (vadd v r) (vadd n m)) + 11 / 8 * (/ 9444732965739290427392 * W)
      <= 19 / 20 * / 4722366482869645213696 * (pow2 a * power_above n) + / 1180591620717411303424 * VM / 100 + 20 * eta /\
    pow2 a * (power_above n + 3 * M) <= W + 3 * VM /\ W <= pow2 a * power_above n + VM).
  { assert (WE : W = pow2 a * pow2 b) by reflexivity. clearbody W. unfold VM. destruct BB as [[B1 [B2 B3]]|[B1 B2]].
    - rewrite B2. specialize (T1 B3). clear - T1 WP M0 VM0 EP WE. unfold VM in *. repeat split; lra.
    - specialize (M1 B2). assert (C : pow2 b <= / 4722366482869645213696 * M).
      { rewrite B1. change (-1022)%Z with (-72 + -950)%Z. rewrite bpow_plus.
        change (pow2 (-72)) with (/ 4722366482869645213696). lra. }
      apply (Rmult_le_compat_l (pow2 a)) in C; [|lra]. rewrite <- WE in C. rewrite B2.
      clear - T2 WP M0 VM0 C EP WE. unfold VM in *. repeat split; lra. }
  destruct H as [H1 [H2 H3]].
  assert (N : eta <= / 21267647932558653966460912964485513216 * (pow2 a * (power_above n + 3 * M)))
    by (apply (eta_le (-951)); [lia | exact G1]).
  assert (G : pow2 a * (power_above n + 3 * M) = pow2 a * power_above n + 3 * VM) by (unfold VM; ring).
  rewrite G in *. assert (PA : 0 <= pow2 a * power_above n).
  { apply Rmult_le_pos; [lra|]. destruct (power_above_spec n) as [[-> _]|[k [_ [-> _]]]]; [lra | apply bpow_ge_0]. }
  set (VN := pow2 a * power_above n) in *.
  unfold pair_near. change (pow2 (-73)) with (/ 9444732965739290427392). change (pow2 (-75)) with (/ 37778931862957161709568).
  split; [exact F1|]. split; [exact F2|]. split; [|split; [|split; [|split; [|split]]]].
  - apply Rle_trans with (Rabs (x + s - inner (vadd v r) (vadd n m)) + Rabs (inner (vadd v r) (vadd n m) - inner (vadd v r) exact)
      + (/ 9444732965739290427392 + 3 / 2 * / 37778931862957161709568) * (W + VM)).
    + apply Rplus_le_compat_r. rewrite Rabs_minus_sym.
      replace (x + s - inner (vadd v r) exact)
        with (x + s - inner (vadd v r) (vadd n m) + (inner (vadd v r) (vadd n m) - inner (vadd v r) exact)) by ring.
      apply Rabs_triang.
    + clear - H1 H2 H3 I N E2 PA VM0 WP. lra.
  - clear - S1 N WP VM0 H2 H3 PA. lra.
  - clear - S2 N WP VM0 H2 H3 PA. lra.
  - exact E1.
  - clear - G2 H3 VM0 PA. lra.
  - clear - E2 H2 VM0 WP. lra.
Qed.

(** ** Where only T's or D's sum is rearranged *)

Lemma near_two_sum exact x s e w : pair_near exact x s e w ->
  pair_near exact (fst (two_sum x s)) (snd (two_sum x s)) e w.
Proof.
  intros [F1 [F2 [H1 [H2 [H3 [H4 [H5 H6]]]]]]]. unfold pair_near.
  assert (R := two_sum_rest x s F1 F2). rewrite u_U in R.
  rewrite two_sum_exact by assumption. repeat split; auto; try (apply two_sum_float; assumption).
  generalize (Rabs_pos (x + s)). lra.
Qed.

Theorem near_correct T D t1 t2 eT d1 d2 eD wT wD :
  is_float t1 -> is_float t2 -> is_float eT -> is_float eD ->
  Rabs (T - (t1 + t2)) + pow2 (-73) * wT <= eT -> Rabs t2 <= pow2 (-23) * wT ->
  Rabs (t1 + t2) <= 4 * wT -> pow2 (-1022) <= eT ->
  pair_near D d1 d2 eD wD ->
  snd (quotient t1 t2 eT d1 d2 eD) = true -> D <> 0 /\ fst (quotient t1 t2 eT d1 d2 eD) = rnd (T / D).
Proof.
  intros F1 F2 F3 F4 T1 T2 T3 T4 [G1 [G2 [D1 [D2 [D3 [D4 [D5 _]]]]]]] Q.
  assert (W : 0 <= wD) by (generalize (Rabs_pos (d1 + d2)); lra).
  assert (E1 : pow2 (-73) * wD <= (pow2 (-73) + 3 / 2 * pow2 (-75)) * wD).
  { apply Rmult_le_compat_r; [exact W|]. generalize (pow2_pos (-75)). lra. }
  assert (E2 : Rabs d2 <= pow2 (-23) * wD) by (change (pow2 (-23)) with (/ 8388608); lra).
  assert (E3 : wD <= pow2 1001) by (change 1001%Z with (1 + 1000)%Z; rewrite bpow_plus; exact D5).
  assert (E4 : Rabs (D - (d1 + d2)) + pow2 (-73) * wD <= eD) by lra.
  assert (E5 : Rabs (d1 + d2) <= 4 * wD) by lra.
  now apply (quotient_correct T D t1 t2 eT d1 d2 eD wT wD).
Qed.

Lemma pair_near_weak exact t1 t2 e w : pair_near exact t1 t2 e w ->
  is_float t1 /\ is_float t2 /\ Rabs (exact - (t1 + t2)) + pow2 (-73) * w <= e /\
  Rabs t2 <= pow2 (-23) * w /\ Rabs (t1 + t2) <= 4 * w /\ pow2 (-1022) <= e.
Proof.
  intros [G1 [G2 [D1 [D2 [D3 [D4 _]]]]]].
  assert (W : 0 <= w) by (generalize (Rabs_pos (t1 + t2)); lra).
  change (pow2 (-75)) with (/ 37778931862957161709568) in D1. change (pow2 (-23)) with (/ 8388608).
  repeat split; auto; lra.
Qed.

Lemma error_float unit size : is_float (error_of unit size). Proof. apply rnd_float. Qed.

(** ** The three cases of [meet] *)

Definition floats (v : vec) : Prop := is_float (px v) /\ is_float (py v) /\ is_float (pz v).
Definition zero : vec := Vec 0 0 0.
Definition minus (v w : vec) : vec := map2 Rminus v w.
Definition sums (a b : vec) : vec := map2 (fun x y => fst (two_sum x (- y))) a b. (* of a and - b *)
Definition rests (a b : vec) : vec := map2 (fun x y => snd (two_sum x (- y))) a b.

Lemma sums_pair a b : floats a -> floats b -> each pair (sums a b) (rests a b).
Proof.
  intros [A1 [A2 A3]] [B1 [B2 B3]]. split; [|split]; apply pair_two_sum; auto using is_float_opp.
Qed.
Lemma sums_exact a b n : floats a -> floats b ->
  inner (vadd (sums a b) (rests a b)) n = inner (minus a b) n.
Proof.
  intros [A1 [A2 A3]] [B1 [B2 B3]]. unfold inner, vadd, sums, rests, minus, map2. cbn [px py pz].
  now rewrite !two_sum_exact by auto using is_float_opp.
Qed.
Lemma zero_pair v : floats v -> each pair v zero.
Proof. intros [A [B C]]. split; [|split]; now apply pair_0. Qed.
Lemma zero_exact v n : inner (vadd v zero) n = inner v n.
Proof. unfold inner, vadd, zero. cbn [px py pz]. ring. Qed.

(** [unit] may be that of all the rays: above a vector that is larger in every component. *)
Definition covers (unit : R) (v : vec) : Prop := exists most : vec, unit = power_above most /\
  Rabs (px v) <= Rabs (px most) /\ Rabs (py v) <= Rabs (py most) /\ Rabs (pz v) <= Rabs (pz most).

Lemma covers_self v : covers (power_above v) v.
Proof. exists v. repeat split; apply Rle_refl. Qed.

Definition prepared_dot (v rest : vec) (unit : R) (n m : vec) : R * R :=
  dot v rest unit (high_half (power_above n) n) (low_half (power_above n) n m).

Lemma known_dot v r unit exact n m M : each pair v r -> covers unit v -> known exact n m M ->
  in_range unit (size_of n M) ->
  exists w, pair_near (inner (vadd v r) exact) (fst (prepared_dot v r unit n m))
    (snd (prepared_dot v r unit n m)) (error_of unit (size_of n M)) w.
Proof.
  intros P [most [-> [C1 [C2 C3]]]] K R. destruct (power_above_spec most) as [[E _]|[k [L [E [W1 [W2 W3]]]]]].
  - exfalso. destruct R as [R _]. revert R. rewrite E, Rmult_0_l, rnd_0. generalize (pow2_pos (-950)). lra.
  - rewrite E in *. apply dot_known; auto; [|lia]. apply pairs_fit; [exact P|].
    repeat split; eapply Rle_trans; eassumption.
Qed.

(** ** The normals of [Quotients.of]: triangles (a, b, c), and planes whose normal is given *)

Theorem triangle_known a b c : floats a -> floats b -> floats c ->
  let '(n, m, M) := cross2 (sums b a) (rests b a) (sums c a) (rests c a) in
  pow2 (-950) < M -> known (exact_cross (minus b a) (minus c a)) n m M.
Proof.
  intros A B C.
  assert (E : forall v, floats v -> vadd (sums v a) (rests v a) = minus v a).
  { intros v [V1 [V2 V3]]. destruct A as [A1 [A2 A3]]. unfold vadd, sums, rests, minus, map2. cbn [px py pz].
    now rewrite !two_sum_exact by auto using is_float_opp. }
  generalize (cross_known _ _ _ _ (sums_pair b a B A) (sums_pair c a C A)).
  now rewrite (E b B), (E c C).
Qed.

Theorem plane_known n : floats n -> known n n zero 0.
Proof.
  intros F. split; [now apply zero_pair|]. split; [now left|]. split; [apply generic_format_0|].
  unfold within, map2, vadd, zero. cbn [px py pz].
  rewrite !Rplus_0_r, !Rminus_diag_eq, !Rabs_R0, Rmult_0_r by reflexivity. repeat split; lra.
Qed.

Section Meet.
Variables exact n m : vec.
Variable M : R.
Hypothesis plane : known exact n m M.
Let size := size_of n M.

(** Rays that share nothing. *)
Definition meet_apart (o d p : vec) : R * bool :=
  let arm := sums p o in
  let reach := power_above arm in
  let along := power_above d in
  let over := prepared_dot arm (rests p o) reach n m in
  let under := prepared_dot d zero along n m in
  quotient (fst over) (snd over) (error_of reach size) (fst under) (snd under) (error_of along size).

Theorem meet_apart_correct o d p : floats o -> floats d -> floats p ->
  in_range (power_above (sums p o)) size -> in_range (power_above d) size ->
  snd (meet_apart o d p) = true ->
  inner d exact <> 0 /\ fst (meet_apart o d p) = rnd (inner (minus p o) exact / inner d exact).
Proof.
  intros Fo Fd Fp R1 R2 Q.
  destruct (known_dot _ _ _ _ _ _ _ (sums_pair p o Fp Fo) (covers_self _) plane R1) as [w1 P1].
  destruct (known_dot _ _ _ _ _ _ _ (zero_pair d Fd) (covers_self _) plane R2) as [w2 P2].
  rewrite sums_exact in P1 by assumption. rewrite zero_exact in P2.
  destruct (pair_near_weak _ _ _ _ _ P1) as [G1 [G2 [G3 [G4 [G5 G6]]]]].
  exact (near_correct _ _ _ _ _ _ _ _ w1 w2 G1 G2 (error_float _ _) (error_float _ _) G3 G4 G5 G6 P2 Q).
Qed.

(** Rays that share their origin: T is prepared, [unit] is above all directions. *)
Definition meet_origin (unit : R) (o d p : vec) : R * bool :=
  let arm := sums p o in
  let reach := power_above arm in
  let over := prepared_dot arm (rests p o) reach n m in
  let table := two_sum (fst over) (snd over) in
  let under := prepared_dot d zero unit n m in
  quotient (fst table) (snd table) (error_of reach size) (fst under) (snd under) (error_of unit size).

Theorem meet_origin_correct unit o d p : floats o -> floats d -> floats p -> covers unit d ->
  in_range (power_above (sums p o)) size -> in_range unit size ->
  snd (meet_origin unit o d p) = true ->
  inner d exact <> 0 /\ fst (meet_origin unit o d p) = rnd (inner (minus p o) exact / inner d exact).
Proof.
  intros Fo Fd Fp C R1 R2 Q.
  destruct (known_dot _ _ _ _ _ _ _ (sums_pair p o Fp Fo) (covers_self _) plane R1) as [w1 P1].
  destruct (known_dot _ _ _ _ _ _ _ (zero_pair d Fd) C plane R2) as [w2 P2].
  rewrite sums_exact in P1 by assumption. rewrite zero_exact in P2. apply near_two_sum in P1.
  destruct (pair_near_weak _ _ _ _ _ P1) as [G1 [G2 [G3 [G4 [G5 G6]]]]].
  exact (near_correct _ _ _ _ _ _ _ _ w1 w2 G1 G2 (error_float _ _) (error_float _ _) G3 G4 G5 G6 P2 Q).
Qed.

(** Rays that share their direction: of T, (p - first origin) . n is prepared, and D. *)
Definition meet_direction (unit : R) (first o d p : vec) : R * bool :=
  let arm := sums p first in
  let reach := power_above arm in
  let along := power_above d in
  let over := prepared_dot arm (rests p first) reach n m in
  let table := two_sum (fst over) (snd over) in
  let error := rnd (error_of reach size + error_of unit size) in
  let under := prepared_dot d zero along n m in
  let part := prepared_dot (sums o first) (rests o first) unit n m in
  let t := two_sum (fst table) (- fst part) in
  quotient (fst t) (rnd (snd t + rnd (snd table - snd part))) error
    (fst under) (snd under) (error_of along size).

Lemma near_difference A B a1 a2 eA wA b1 b2 eB wB : is_float eA -> is_float eB ->
  pair_near A a1 a2 eA wA -> pair_near B b1 b2 eB wB -> Rabs a2 <= U * Rabs (a1 + a2) ->
  let t := two_sum a1 (- b1) in let t2 := rnd (snd t + rnd (a2 - b2)) in let w := wA + wB in
  Rabs (A - B - (fst t + t2)) + pow2 (-73) * w <= rnd (eA + eB) /\ Rabs t2 <= pow2 (-23) * w /\
  Rabs (fst t + t2) <= 4 * w /\ pow2 (-1022) <= rnd (eA + eB).
Proof.
  intros FA FB [A1 [A2 [A3 [A4 [A5 [A6 [_ A8]]]]]]] [B1 [B2 [B3 [B4 [B5 [B6 [_ B8]]]]]]] R t t2 w.
  assert (N1 := is_float_opp _ B1).
  assert (X := two_sum_exact a1 (- b1) A1 N1). assert (Y := two_sum_rest a1 (- b1) A1 N1).
  assert (Ft := two_sum_float a1 (- b1)). fold t in X, Y, Ft. rewrite u_U in Y.
  assert (WA : 0 <= wA) by (generalize (Rabs_pos (a1 + a2)); lra).
  assert (WB : 0 <= wB) by (generalize (Rabs_pos (b1 + b2)); lra).
  change (pow2 (-75)) with (/ 37778931862957161709568) in *.
  change (pow2 (-73)) with (/ 9444732965739290427392) in *. change (pow2 (-23)) with (/ 8388608).
  assert (P := pow2_pos (-1022)).
  assert (E : (1 - U) * (eA + eB) <= rnd (eA + eB) /\ pow2 (-1022) <= rnd (eA + eB)).
  { split.
    - apply relative. lra.
    - rewrite <- (rnd_id (pow2 (-1022))) by now apply float_pow2. apply rnd_le. lra. }
  assert (Y' : Rabs (snd t) <= 5 * U * (wA + wB)).
  { assert (Z : Rabs (a1 + - b1) <= 5 * (wA + wB)); [|lra]. clear - A4 A5 B4 B5 WA WB. abs. }
  assert (C1 : Rabs (a2 - b2) <= 5 * U * wA + 15 / 2 * F26 * wB).
  { clear - R A5 B4 WA. apply Rle_trans with (Rabs a2 + Rabs b2); [|lra].
    unfold Rminus. rewrite <- (Rabs_Ropp b2). apply Rabs_triang. }
  assert (Q1 := off_diff _ _ _ A2 B2 C1). set (r := rnd (a2 - b2)) in *.
  assert (C2 : Rabs (snd t + r) <= 761 / 100 * F26 * (wA + wB)) by (clear - Y' C1 Q1 WA WB; abs).
  assert (Q2 := off_sum (snd t) r _ (proj2 Ft) (rnd_float _) C2). fold t2 in Q2.
  destruct E as [E1 E2]. split; [|split; [|split]].
  - assert (H : Rabs (A - B - (fst t + t2)) <= Rabs (A - (a1 + a2)) + Rabs (B - (b1 + b2))
      + 1515 / 100 * U * F26 * (wA + wB)).
    { assert (H1 := Rle_refl (Rabs (A - (a1 + a2)))). assert (H2 := Rle_refl (Rabs (B - (b1 + b2)))).
      set (p := Rabs (A - (a1 + a2))) in H1 at 2 |- *. set (q := Rabs (B - (b1 + b2))) in H2 at 2 |- *.
      clearbody p q. clear - H1 H2 X Q1 Q2 WA WB. abs. }
    unfold w. clear - H E1 A3 B3 A8 B8 WA WB. lra.
  - unfold w. clear - C2 Q2 WA WB. abs.
  - unfold w. clear - C2 Q2 WA WB A5 B5 X Q1 C1 Y'. abs.
  - exact E2.
Qed.

Theorem meet_direction_correct unit first o d p : floats first -> floats o -> floats d -> floats p ->
  covers unit (sums o first) ->
  in_range (power_above (sums p first)) size -> in_range unit size -> in_range (power_above d) size ->
  snd (meet_direction unit first o d p) = true ->
  inner d exact <> 0 /\ fst (meet_direction unit first o d p) = rnd (inner (minus p o) exact / inner d exact).
Proof.
  intros Ff Fo Fd Fp C R1 R2 R3 Q.
  destruct (known_dot _ _ _ _ _ _ _ (sums_pair p first Fp Ff) (covers_self _) plane R1) as [w1 P1].
  destruct (known_dot _ _ _ _ _ _ _ (sums_pair o first Fo Ff) C plane R2) as [w2 P2].
  destruct (known_dot _ _ _ _ _ _ _ (zero_pair d Fd) (covers_self _) plane R3) as [w3 P3].
  rewrite sums_exact in P1, P2 by assumption. rewrite zero_exact in P3.
  assert (K : inner (minus p o) exact = inner (minus p first) exact - inner (minus o first) exact).
  { unfold inner, minus, map2. cbn [px py pz]. ring. }
  rewrite K.
  assert (S := two_sum_rest _ _ (proj1 P1) (proj1 (proj2 P1))). rewrite u_U in S.
  rewrite <- (two_sum_exact _ _ (proj1 P1) (proj1 (proj2 P1))) in S. apply near_two_sum in P1.
  destruct (near_difference _ _ _ _ _ _ _ _ _ _ (error_float _ _) (error_float _ _) P1 P2 S) as [G1 [G2 [G3 G4]]].
  exact (near_correct _ _ _ _ _ _ _ _ _ w3 (rnd_float _) (rnd_float _) (rnd_float _) (error_float _ _) G1 G2 G3 G4 P3 Q).
Qed.
End Meet.
