(** Steps of Fit.v and FitParallel.v: a place on the film, counted from a pixel; and signs.

    p - x0 w is off by what p is, by x0 times what w is, and by two roundings. The [width + height] in
    [place] of [film.py] is for the former; here it is spent. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Camera Place Film Dual Bounds Boxes.
Open Scope R_scope.
Opaque rnd.

(** ** One axis: p - z w, as computed, from a pixel z of the picture on *)

Lemma relative_along S re a other e c w C0 w0 off Z z : 1 <= S -> axis_ok a -> axis_ok other ->
  Rabs e <= / 2 -> bpow radix2 (-970) <= Z -> 0 <= re -> 0 <= z <= count a ->
  near c C0 (106 * (u * (S * Z))) -> near w w0 (106 * (u * (S * Z))) ->
  Rabs C0 <= 101 / 100 * (S * Z) -> Rabs w0 <= 101 / 100 * (S * Z) ->
  Rabs off <= 12 / 100 * re * (1 + reach a) / pixel a + u * (Rabs (start a) / pixel a + 5 * count a) ->
  near (rnd (film_position c w (start a) (pixel a) e - rnd (z * w)))
    ((C0 - start a * w0) / pixel a - e * w0 - off * w0 - z * w0) (9 / 10 * (slope_of S re a other * Z)).
Proof.
  intros HS [Wa [N R0]] [_ [N' _]] E HZ RE Hz Hc Hw Bc Bw Boff. assert (U := eta_unit S HS Z HZ).
  assert (PZ := Z_pos Z HZ). assert (P := u_pos). assert (T := u_tiny).
  assert (Pw : 0 < pixel a) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact (proj1 Wa)]).
  set (k' := / pixel a). assert (Pk : 0 < k') by now apply Rinv_0_lt_compat.
  set (l := Rabs (start a)) in *. assert (Pl : 0 <= l) by apply Rabs_pos.
  set (n := S * Z) in *. assert (Pn : 0 < n) by (apply Rmult_lt_0_compat; lra).
  assert (Pun : 0 < u * n) by now apply Rmult_lt_0_compat.
  assert (H1 : 0 <= u * n * (l * k')) by (repeat (lra || apply Rmult_le_pos)).
  assert (H2 : 0 <= u * n * k') by (repeat (lra || apply Rmult_le_pos)).
  assert (H3 : 0 <= re * n * ((1 + reach a) * k')) by (repeat (lra || apply Rmult_le_pos)).
  assert (H4 : u * n * 1 <= u * n * count a) by (apply Rmult_le_compat_l; lra).
  assert (H5 : u * n * 1 <= u * n * count other) by (apply Rmult_le_compat_l; lra).
  assert (F := film_place c C0 w w0 (start a) (pixel a) e n n Hc Hw Bc Bw Wa E U U). fold l in F.
  set (p := film_position c w (start a) (pixel a) e) in *.
  set (p0 := (C0 - start a * w0) / pixel a - e * w0) in *.
  replace (u * (111 * n + 112 * (l * n)) / pixel a + 55 * (u * n))
    with (111 * (u * n * k') + 112 * (u * n * (l * k')) + 55 * (u * n)) in F by (unfold k'; field; lra).
  assert (B0 : Rabs p0 <= 101 / 100 * (n * k' + n * (l * k')) + 101 / 200 * n).
  { unfold p0. replace (101 / 100 * (n * k' + n * (l * k')) + 101 / 200 * n) with
      ((101 / 100 * n + l * (101 / 100 * n)) * k' + / 2 * (101 / 100 * n)) by field.
    apply tri; [|now apply prod].
    apply prod; [apply tri; [exact Bc | apply prod; [apply Rle_refl | exact Bw]]|].
    fold k'. rewrite Rabs_pos_eq; lra. }
  assert (Bz : Rabs (z * w0) <= 101 / 100 * (n * count a)).
  { replace (101 / 100 * (n * count a)) with (count a * (101 / 100 * n)) by field.
    apply prod; [rewrite Rabs_pos_eq; lra | exact Bw]. }
  assert (W1 : near (rnd (z * w)) (z * w0) (10704 / 100 * (u * n * count a))).
  { eapply near_rnd; [apply near_scale; exact Hw | exact Bz |]. rewrite Rabs_pos_eq by lra.
    assert (z * (106 * (u * n)) <= count a * (106 * (u * n))) by (apply Rmult_le_compat_r; lra).
    replace (u * (101 / 100 * (n * count a))) with (101 / 100 * (u * n * count a)) by field. lra. }
  assert (D := near_sub _ _ _ _ _ _ F W1).
  assert (B1 := tri _ _ _ _ B0 Bz).
  assert (G : near (rnd (p - rnd (z * w))) (p0 - z * w0)
    (1122 / 10 * (u * n * k') + 1132 / 10 * (u * n * (l * k')) + 555 / 10 * (u * n) + 1081 / 10 * (u * n *
      count a))).
  { eapply near_rnd; [exact D | exact B1 |].
    replace (u * (101 / 100 * (n * k' + n * (l * k')) + 101 / 200 * n + 101 / 100 * (n * count a))) with
      (101 / 100 * (u * n * k') + 101 / 100 * (u * n * (l * k')) + 101 / 200 * (u * n) + 101 / 100 * (u * n
        * count a))
      by field. lra. }
  replace (p0 - off * w0 - z * w0) with ((p0 - z * w0) - off * w0) by ring.
  eapply near_le.
  - eapply near_trans; [exact G|]. unfold near.
    replace (p0 - z * w0 - (p0 - z * w0 - off * w0)) with (off * w0) by ring.
    apply prod; [exact Boff | exact Bw].
  - replace (slope_of S re a other * Z) with
      (144 * (u * n * k') + 272 * (u * n * (l * k')) + 128 * (u * n * count a) + 128 * (u * n * count other)
       + 2 * (re * n * ((1 + reach a) * k'))).
    2: { unfold slope_of, n, k', l. field. lra. }
    replace ((12 / 100 * re * (1 + reach a) / pixel a + u * (l / pixel a + 5 * count a)) * (101 / 100 * n))
      with (101 / 100 * (u * n * (l * k')) + 505 / 100 * (u * n * count a)
            + 1212 / 10000 * (re * n * ((1 + reach a) * k'))) by (unfold k'; field; lra).
    lra.
Qed.

(** The size of a vertex is at least 2^-960, as [_TINY] was added. *)
Lemma size_some V O : 0 <= V -> 0 <= O -> bpow radix2 (-960) <= vertex_size V O.
Proof.
  intros HV HO. assert (F : is_float (bpow radix2 (-960))).
  { apply generic_format_bpow. unfold fexp, FLT_exp, prec. lia. }
  rewrite <- (rnd_id _ F). unfold vertex_size. apply rnd_le.
  assert (rnd (bpow radix2 (-960)) <= rnd (O + tiny)) by (apply rnd_le; unfold tiny; lra).
  rewrite (rnd_id _ F) in H. lra.
Qed.

(** ** Signs: what is decided of determinants is decided of the ray *)

(** The edge functions are determinants times one factor; where all have T's sign, so have they. *)
Lemma all_inside k T x y z : k <> 0 -> T * x > 0 -> T * y > 0 -> T * z > 0 ->
  (0 < k * x /\ 0 < k * y /\ 0 < k * z) \/ (k * x < 0 /\ k * y < 0 /\ k * z < 0).
Proof.
  intros K X Y Z. assert (T0 : T <> 0) by (intros E; rewrite E in X; lra).
  assert (G : forall e, T * e > 0 -> (0 < k * T -> 0 < k * e) /\ (k * T < 0 -> k * e < 0)).
  { intros e E. assert (TT : 0 < T * T) by nra.
    assert (Q : k * e * (T * T) = k * T * (T * e)) by ring. split; intros S.
    - assert (0 < k * T * (T * e)) by (apply Rmult_lt_0_compat; lra). nra.
    - assert (0 < - (k * T) * (T * e)) by (apply Rmult_lt_0_compat; lra). nra. }
  destruct (G x X) as [X1 X2], (G y Y) as [Y1 Y2], (G z Z) as [Z1 Z2].
  destruct (Rtotal_order 0 (k * T)) as [H|[H|H]]; [left; auto | | right; auto].
  exfalso. symmetry in H. apply Rmult_integral in H. tauto.
Qed.
Lemma same_sign k T x : 0 < k * T -> 0 <= k * x -> 0 <= T * x.
Proof.
  intros A B. assert (k <> 0) by (intros E; rewrite E in A; lra). assert (0 < k * k) by nra.
  assert (0 <= k * T * (k * x)) by (apply Rmult_le_pos; lra).
  assert (k * T * (k * x) = k * k * (T * x)) by ring. nra.
Qed.
Lemma same_sign' k T x : k * T < 0 -> k * x <= 0 -> 0 <= T * x.
Proof. intros. apply (same_sign (- k)); lra. Qed.

Lemma pos_left x y : 0 < x * y -> 0 < y -> 0 < x. Proof. intros. nra. Qed.
Lemma neg_left x y : 0 < x * y -> y < 0 -> x < 0. Proof. intros. nra. Qed.
Lemma quotient_pos x y : y <> 0 -> 0 < x / y -> 0 < x * y.
Proof.
  intros Y H. replace (x * y) with (x / y * (y * y)) by (field; exact Y).
  apply Rmult_lt_0_compat; [exact H | nra].
Qed.
Lemma square_pos x : x <> 0 -> 0 < x * x. Proof. intros. nra. Qed.
Lemma keeps_sign k x : k <> 0 ->
  (0 <= k * x -> (0 < k /\ 0 <= x) \/ (k < 0 /\ x <= 0)) /\ (k * x <= 0 -> (0 < k /\
    x <= 0) \/ (k < 0 /\ 0 <= x)).
Proof. intros K. destruct (Rtotal_order 0 k) as [H|[H|H]]; [| lra |]; split; intros;
  [left|left|right|right]; nra. Qed.
