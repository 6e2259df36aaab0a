(** What is said of a cell holds at all of its pixels; the depth buffer; nearness from t.

    See "Boxes, cells, blocks" and "Front to back" in docs/speed.md; the code is `_may_be_seen` in
    rasterise.py, and depth_buffer.py with its `nearness`. Rounding is monotone, so what was
    computed at a cell's corner bounds, to the last bit, what is computed at each of its pixels. *)
Require Import ZArith Reals Psatz List.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding EdgeFunctions.
Open Scope R_scope.

(** ** Cells of pixels *)

(** At the corner of a box of pixels where the function is largest. *)
Definition at_corner (c1 cy cx up0 up1 right0 right1 : R) : R :=
  at_pixel c1 cy cx (if Rlt_bool 0 cy then up1 else up0) (if Rlt_bool 0 cx then right1 else right0).

Lemma corner_product c x0 x1 x : x0 <= x <= x1 ->
  rnd (c * x) <= rnd (c * (if Rlt_bool 0 c then x1 else x0)).
Proof. intros H. apply rnd_le. destruct (Rlt_bool_spec 0 c); nra. Qed.

(** No pixel of the box has more, as computed. *)
Theorem corner_is_most c1 cy cx up0 up1 right0 right1 up right :
  up0 <= up <= up1 -> right0 <= right <= right1 ->
  at_pixel c1 cy cx up right <= at_corner c1 cy cx up0 up1 right0 right1.
Proof.
  intros U R. unfold at_corner, at_pixel.
  apply rnd_le, Rplus_le_compat; [|now apply corner_product].
  apply rnd_le, Rplus_le_compat_l. now apply corner_product.
Qed.

(** Three edges, and the nearness: the coefficients of 1, y and x of each. *)
Record linear := Linear { l1 : R; ly : R; lx : R }.
Definition at_ (f : linear) (up right : R) : R := at_pixel (l1 f) (ly f) (lx f) up right.
Definition most_of (f : linear) : R -> R -> R -> R -> R := at_corner (l1 f) (ly f) (lx f).

Section Cell.
Variables (e1 e2 e3 n : linear) (error nearness_error nearest farthest up0 up1 right0 right1 : R).
Let most f := most_of f up0 up1 right0 right1.
Let least_at up right := Rmin (Rmin (at_ e1 up right) (at_ e2 up right)) (at_ e3 up right).

(** An edge rules the cell out: it would be found in no pixel. *)
Theorem ruled_out : Rmin (Rmin (most e1) (most e2)) (most e3) < - error ->
  forall up right, up0 <= up <= up1 -> right0 <= right <= right1 -> ~ (least_at up right >= - error).
Proof.
  intros H up right U R. apply Rlt_not_ge. eapply Rle_lt_trans; [|exact H].
  unfold least_at. apply Rmin_glb; [apply Rmin_glb|].
  - eapply Rle_trans; [apply Rmin_l|]. eapply Rle_trans; [apply Rmin_l|]. now apply corner_is_most.
  - eapply Rle_trans; [apply Rmin_l|]. eapply Rle_trans; [apply Rmin_r|]. now apply corner_is_most.
  - eapply Rle_trans; [apply Rmin_r|]. now apply corner_is_most.
Qed.

(** The most that the nearness of a pixel's fragment can be, as `_block` has it. *)
Definition most_at up right := Rmin (rnd (at_ n up right + nearness_error)) nearest.

(** What is in the depth buffer hides the cell: at each pixel it is nearer than the fragment. *)
Theorem hidden : rnd (most n + nearness_error) < farthest ->
  forall up right, up0 <= up <= up1 -> right0 <= right <= right1 -> most_at up right < farthest.
Proof.
  intros H up right U R. eapply Rle_lt_trans; [apply Rmin_l|]. eapply Rle_lt_trans; [|exact H].
  apply rnd_le, Rplus_le_compat_r. now apply corner_is_most.
Qed.
End Cell.

(** ** The depth buffer *)

(** At a pixel: between what its winner's nearness lies, which surface that is, and what was entered.
    [None] is a pixel without a winner. Among the rivals is what may be nearer than the winner. *)
Record entry := Entry { surface : nat; least : R; most : R }.
Record pixel := Pixel { winner : option entry; rivals : list entry }.
Definition behind (e : entry) (p : pixel) : Prop :=
  match winner p with None => False | Some w => most e < least w end.

(** One step of `enter`, for one pixel. *)
Definition enter (p : pixel) (e : entry) : pixel :=
  match winner p with
  | None => Pixel (Some e) (rivals p)
  | Some w =>
      if Rlt_bool (least w) (least e)
      then Pixel (Some e) (if Rlt_bool (most w) (least e) then rivals p else w :: rivals p)
      else Pixel (Some w) (if Rlt_bool (most e) (least w) then rivals p else e :: rivals p)
  end.

(** What is in doubt never wins: it is kept, or behind. *)
Definition doubt (p : pixel) (e : entry) : pixel :=
  match winner p with
  | None => Pixel None (e :: rivals p)
  | Some w => if Rlt_bool (most e) (least w) then p else Pixel (Some w) (e :: rivals p)
  end.
Definition step (p : pixel) (x : bool * entry) : pixel := (if fst x then enter else doubt) p (snd x).

(** Each that was ever seen is the winner, or a rival, or surely behind the winner: then it stays
    so, as the depth buffer only grows. *)
Definition kept (p : pixel) (x : entry) : Prop := winner p = Some x \/ In x (rivals p) \/ behind x p.
Theorem step_keeps p e : kept (step p e) (snd e) /\ forall x, kept p x -> kept (step p e) x.
Proof.
  destruct e as [[] e]; unfold step, kept, behind, enter, doubt; simpl; split.
  - destruct (winner p) as [w|]; simpl; auto.
    case Rlt_bool_spec; simpl; auto. intros _. case Rlt_bool_spec; intros; simpl; auto.
  - intros x H. destruct (winner p) as [w|] eqn:W; simpl.
    + case Rlt_bool_spec; intros L; simpl.
      * destruct H as [H|[H|H]].
        -- injection H as ->. case Rlt_bool_spec; simpl; auto.
        -- right. left. case Rlt_bool_spec; simpl; auto.
        -- right. right. lra.
      * destruct H as [H|[H|H]]; auto.
        right. left. case Rlt_bool_spec; simpl; auto.
    + destruct H as [H|[H|[]]]; [discriminate | auto].
  - destruct (winner p) as [w|] eqn:W; simpl; auto.
    case Rlt_bool_spec; intros; simpl; auto. right. right. now rewrite W.
  - intros x H. destruct (winner p) as [w|] eqn:W; simpl.
    + case Rlt_bool_spec; intros; simpl; [now rewrite W|]. destruct H as [H|[H|H]]; auto.
    + destruct H as [H|[H|[]]]; [discriminate | auto].
Qed.
Theorem only_grows p e w : winner p = Some w -> exists v, winner (step p e) = Some v /\ least w <= least v.
Proof.
  intros W. destruct e as [[] e]; unfold step, enter, doubt; simpl; rewrite W; case Rlt_bool_spec; intros;
    eexists; (split; [try reflexivity; exact W | lra]).
Qed.

Definition nothing : pixel := Pixel None nil.
Theorem all_kept l x : In x (map snd l) -> kept (fold_left step l nothing) x.
Proof.
  assert (K : forall l p, kept p x -> kept (fold_left step l p) x).
  { induction l0; simpl; intros; auto. apply IHl0. now apply (proj2 (step_keeps _ _)). }
  generalize nothing. induction l as [|y l I]; simpl; intros p H; [easy|].
  destruct H as [<-|H]; [|now apply I]. apply K, (proj1 (step_keeps p y)).
Qed.

(** The winner is one that was sure. *)
Theorem winner_was_sure l w : winner (fold_left step l nothing) = Some w -> In (true, w) l.
Proof.
  assert (G : forall l p, winner (fold_left step l p) = Some w -> In (true, w) l \/ winner p = Some w).
  { induction l0 as [|[s e] l0 I]; simpl; intros p W; auto.
    destruct (I _ W) as [H|H]; auto. revert H. unfold step, enter, doubt. simpl.
    destruct s, (winner p) as [v|] eqn:V; simpl; try discriminate; auto;
      try (case Rlt_bool_spec; simpl; intros _; rewrite ?V; auto); intros E; injection E as ->; auto. }
  intros W. destruct (G l nothing W) as [H|H]; [exact H | discriminate].
Qed.

(** So, where no rival may reach the winner, it is the nearest of all that was seen, whatever the
    true nearness of each is between its least and its most. *)
Theorem winner_is_nearest l w (nearness : entry -> R) :
  (forall x, In x (map snd l) -> least x <= nearness x <= most x) ->
  let p := fold_left step l nothing in
  winner p = Some w -> (forall x, In x (rivals p) -> most x < least w) ->
  forall x, In x (map snd l) -> x = w \/ nearness x < nearness w.
Proof.
  intros B p W N x H.
  assert (Bw : least w <= nearness w) by (apply B, (in_map snd l (true, w)), winner_was_sure, W).
  assert (Bx := B x H). destruct (all_kept l x H) as [K|[K|K]]; fold p in K.
  - left. congruence.
  - right. generalize (N x K). lra.
  - right. unfold behind in K. rewrite W in K. lra.
Qed.

(** `enter` itself takes many at a time, one pixel several times, and of several writes the last one
    stays: so what was overwritten comes again, in rounds. Here is one round, for one pixel, of sure
    hits of different surfaces; what is left is for the next. *)
Section Rounds.
Let nearer (p : pixel) (e : entry) : bool :=
  match winner p with None => true | Some w => Rlt_bool (least w) (least e) end.
Let reaches (x e : entry) : bool := negb (Rlt_bool (most x) (least e)).
Definition beaten (p : pixel) (near : list entry) : list entry :=
  match winner p with None => nil | Some w => if existsb (reaches w) near then w :: nil else nil end.
Definition too_far (p : pixel) (l : list entry) : list entry :=
  match winner p with None => nil | Some w => filter (fun e => negb (nearer p e) && reaches e w)%bool l end.
Definition round (p : pixel) (l : list entry) : pixel * list entry :=
  let near := filter (nearer p) l in
  match rev near with
  | nil => (Pixel (winner p) (too_far p l ++ rivals p), nil)
  | z :: _ => (Pixel (Some z) (beaten p near ++ too_far p l ++ rivals p),
      rev (filter (fun e => negb (Nat.eqb (surface e) (surface z))) near))
  end.

Lemma not_less x y : Rlt_bool x y = true <-> x < y.
Proof. case Rlt_bool_spec; split; intros; auto; [discriminate | lra]. Qed.

Lemma round_keeps p l : NoDup (map surface l) ->
  let r := round p l in
  (forall x, kept p x -> kept (fst r) x) /\ (forall x, In x l -> kept (fst r) x \/ In x (snd r)).
Proof.
  intros D. unfold round. set (near := filter (nearer p) l).
  assert (F : forall x w, In x l -> winner p = Some w -> nearer p x = false -> In x (too_far p l) \/ most x < least w).
  { intros x w I W N. unfold too_far. rewrite W. destruct (Rlt_bool (most x) (least w)) eqn:E.
    - right. now apply not_less.
    - left. apply filter_In. split; auto. unfold reaches. now rewrite N, E. }
  destruct (rev near) as [|z rest] eqn:R; simpl.
  - assert (N : near = nil) by (rewrite <- (rev_involutive near), R; easy). split.
    + intros x [H|[H|H]]; unfold kept, behind in *; simpl; auto. right. left. apply in_or_app. auto.
    + intros x I. left. unfold kept, behind. simpl. destruct (nearer p x) eqn:E.
      * assert (In x near) by (apply filter_In; auto). rewrite N in H. easy.
      * destruct (winner p) as [w|] eqn:W; [|unfold nearer in E; rewrite W in E; discriminate].
        destruct (F x w I eq_refl E); auto. right. left. apply in_or_app. auto.
  - assert (Z : In z near) by (apply in_rev; rewrite R; now left).
    assert (Zn : nearer p z = true /\ In z l) by (apply filter_In in Z; tauto).
    assert (G : forall w, winner p = Some w -> least w < least z).
    { intros w W. destruct Zn as [Zn _]. unfold nearer in Zn. rewrite W in Zn. now apply not_less. }
    split.
    + intros x H. unfold kept, behind. simpl. destruct H as [H|[H|H]].
      * unfold beaten. rewrite H. destruct (existsb (reaches x) near) eqn:E; [right; left; now left|].
        right. right. destruct (Rlt_bool (most x) (least z)) eqn:L; [now apply not_less|].
        assert (existsb (reaches x) near = true); [|congruence].
        apply existsb_exists. exists z. split; auto. unfold reaches. now rewrite L.
      * right. left. apply in_or_app. right. apply in_or_app. auto.
      * right. right. unfold behind in H. destruct (winner p) as [w|]; [|easy]. generalize (G w eq_refl). lra.
    + intros x I. destruct (nearer p x) eqn:E.
      * destruct (Nat.eqb (surface x) (surface z)) eqn:S.
        -- left. left. simpl. f_equal. apply Nat.eqb_eq in S. destruct Zn as [_ Zl]. clear - D I Zl S.
           induction l as [|y l IH]; simpl in *; [easy|]. inversion D as [|? ? D1 D2]; subst.
           destruct I as [->|I], Zl as [->|Zl]; auto.
           ++ exfalso. apply D1. rewrite S. now apply in_map.
           ++ exfalso. apply D1. rewrite <- S. now apply in_map.
        -- right. apply in_rev. rewrite rev_involutive. apply filter_In. rewrite S. split; auto. apply filter_In; auto.
      * left. unfold kept, behind. simpl.
        destruct (winner p) as [w|] eqn:W; [|unfold nearer in E; rewrite W in E; discriminate].
        destruct (F x w I eq_refl E) as [K|K]; [right; left; apply in_or_app; right; apply in_or_app; auto|].
        right. right. generalize (G w eq_refl). lra.
Qed.
Lemma filter_le (g : entry -> bool) l : (length (filter g l) <= length l)%nat.
Proof. induction l; simpl; auto. destruct (g a); simpl; lia. Qed.
Lemma filter_less (g : entry -> bool) l z : In z l -> g z = false -> (length (filter g l) < length l)%nat.
Proof.
  induction l as [|y l I]; simpl; [easy|]. assert (L := filter_le g l).
  intros [->|H] G; [rewrite G; lia|]. specialize (I H G). destruct (g y); simpl; lia.
Qed.
Lemma distinct_filter (g : entry -> bool) l : NoDup (map surface l) -> NoDup (map surface (filter g l)).
Proof.
  induction l as [|y l I]; simpl; intros D; auto. inversion D as [|? ? D1 D2]; subst.
  destruct (g y); simpl; auto. constructor; auto. intros H. apply D1.
  apply in_map_iff in H. destruct H as [x [E H]]. rewrite <- E. apply in_map. apply filter_In in H. tauto.
Qed.
Lemma round_shrinks p l : NoDup (map surface l) ->
  NoDup (map surface (snd (round p l))) /\ (length (snd (round p l)) <= Nat.pred (length l))%nat.
Proof.
  intros D. unfold round. destruct (rev (filter (nearer p) l)) as [|z rest] eqn:R; simpl; [split; [constructor | lia]|].
  assert (Z : In z (filter (nearer p) l)) by (apply in_rev; rewrite R; now left). split.
  - rewrite map_rev. apply NoDup_rev. now do 2 apply distinct_filter.
  - rewrite rev_length. assert (L := filter_le (nearer p) l).
    assert (K := filter_less (fun e => negb (Nat.eqb (surface e) (surface z))) _ z Z).
    cbv beta in K. rewrite Nat.eqb_refl in K. specialize (K eq_refl). lia.
Qed.

(** There are no more rounds than hits, and at the end all are kept. *)
Fixpoint rounds (n : nat) (p : pixel) (l : list entry) : pixel :=
  match n with O => p | S n => let r := round p l in rounds n (fst r) (snd r) end.
Theorem rounds_keep n p l : NoDup (map surface l) -> (length l <= n)%nat ->
  (forall x, kept p x -> kept (rounds n p l) x) /\ (forall x, In x l -> kept (rounds n p l) x).
Proof.
  revert p l. induction n as [|n I]; simpl; intros p l D L.
  - destruct l; simpl in *; [split; auto; easy | lia].
  - destruct (round_keeps p l D) as [K1 K2]. destruct (round_shrinks p l D) as [D' L'].
    destruct (I (fst (round p l)) (snd (round p l)) D' ltac:(lia)) as [I1 I2].
    split; intros x H; auto. destruct (K2 x H); auto.
Qed.
End Rounds.

(** ** The smallest nearness in a cell *)

Fixpoint least_in (l : list R) (from : R) : R :=
  match l with nil => from | x :: l => Rmin x (least_in l from) end.
Lemma least_in_le l from x : In x l -> least_in l from <= x.
Proof.
  induction l; simpl; [easy|]. intros [->|H]; [apply Rmin_l|].
  eapply Rle_trans; [apply Rmin_r | auto].
Qed.

(** Taken at some time, it is a lower bound later, too: no pixel's nearness is ever made less. *)
Theorem least_is_bound (pixels : list nat) (old new : nat -> R) from :
  (forall i, old i <= new i) ->
  forall i, In i pixels -> least_in (map old pixels) from <= new i.
Proof.
  intros G i H. eapply Rle_trans; [|apply G]. apply least_in_le. now apply in_map.
Qed.

(** `farthest_in`: a box of less than two cells a side lies in the cells that are asked, which are,
    along each axis, that of its lowest pixel and that of the pixel 8 further, or its last, each with
    the next one. Of a box of 8 pixels or less a side, the first and the next are enough. *)
Theorem around_small low high x : (low <= x <= high -> high - low < 8 ->
  x / 8 = low / 8 \/ x / 8 = low / 8 + 1)%Z.
Proof. intros. Z.to_euclidean_division_equations. lia. Qed.
Theorem around_large low high x : (low <= x <= high -> high - low < 16 ->
  let r := Z.min (low + 8) high in
  x / 8 = low / 8 \/ x / 8 = low / 8 + 1 \/ x / 8 = r / 8 \/ x / 8 = r / 8 + 1)%Z.
Proof. intros H L r. unfold r. destruct (Zmin_spec (low + 8) high) as [[_ ->]|[_ ->]];
  Z.to_euclidean_division_equations; lia. Qed.

(** ** Nearness from t, and the clip range *)

(** 1 / t for t between low and high, with [room] = 4 u for rounding: as the code computes it. Both
    1 - room and 1 + room are floats. The code has 0 for a high that is infinite, which bounds any
    1 / t from below, and inf for a low that is 0 or less. The 4 is just enough: at t near 2^1024,
    the largest float, half the step between floats of 1 / t is 4 u / t. *)
Definition room4 : R := 4 * u.
Definition nearness_low (room high : R) : R := rnd ((1 - room) / high).
Definition nearness_high (room low : R) : R := rnd ((1 + room) / low).

Lemma small_err x : Rabs x < bpow radix2 (-1021) -> Rabs (rnd x - x) <= eta.
Proof.
  intros H. replace eta with (/ 2 * ulp radix2 fexp x); [apply error_le_half_ulp, fexp_valid|].
  unfold eta. now rewrite (ulp_FLT_small radix2 (-1074) prec) by exact H.
Qed.

(** Rounding takes (1 + x) / t no farther than 4 u / t. *)
Lemma inverse_end t x : 0 < t <= bpow radix2 1024 -> Rabs x <= room4 ->
  Rabs (rnd ((1 + x) / t) - (1 + x) / t) <= 4 * u * / t.
Proof.
  intros [P L] X. assert (I : 0 < / t) by (apply Rinv_0_lt_compat; lra).
  assert (U := u_pos). assert (V := u_small). unfold room4 in X.
  destruct (Rle_or_lt (bpow radix2 (-1022)) (Rabs ((1 + x) / t))) as [H|H].
  - eapply Rle_trans; [now apply rnd_err_rel|]. unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ t)) by lra.
    rewrite <- Rmult_assoc. apply Rmult_le_compat_r; [lra|].
    assert (Rabs (1 + x) <= 4); [|nra]. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_R1. lra.
  - eapply Rle_trans; [apply small_err; eapply Rlt_trans; [exact H | apply bpow_lt; lia]|].
    assert (K : / bpow radix2 1024 <= / t) by (apply Rinv_le; lra). rewrite <- bpow_opp in K.
    rewrite u_bpow. change 4 with (bpow radix2 2). rewrite <- bpow_plus.
    apply Rle_trans with (bpow radix2 (2 + -53) * bpow radix2 (- (1024))); [|apply Rmult_le_compat_l; [apply bpow_ge_0 | exact K]].
    unfold eta. change (/ 2) with (bpow radix2 (-1)). rewrite <- !bpow_plus. apply bpow_le. lia.
Qed.

Lemma inverse_below t : 0 < t <= bpow radix2 1024 -> nearness_low room4 t <= / t <= nearness_high room4 t.
Proof.
  intros T. assert (I : 0 < / t) by (apply Rinv_0_lt_compat; lra). assert (U := u_pos).
  assert (L := inverse_end t (- room4) T). assert (H := inverse_end t room4 T).
  rewrite Rabs_Ropp in L. unfold room4 in *. rewrite Rabs_pos_eq in * by lra.
  specialize (L ltac:(lra)). specialize (H ltac:(lra)). unfold nearness_low, nearness_high, Rminus.
  apply Rabs_le_inv in L, H. unfold Rdiv in *. split; lra.
Qed.

(** What is between low and high has its inverse between the two. *)
Theorem nearness_encloses low high t : 0 < low -> low <= t <= high -> high <= bpow radix2 1024 ->
  nearness_low room4 high <= / t <= nearness_high room4 low.
Proof.
  intros L T H. split.
  - eapply Rle_trans; [apply (inverse_below high); lra | apply Rinv_le; lra].
  - eapply Rle_trans; [apply Rinv_le; [|apply T]; lra | apply (inverse_below low); lra].
Qed.
Theorem nearness_encloses_low high t : 0 < t <= high -> high <= bpow radix2 1024 -> nearness_low room4 high <= / t.
Proof. intros T H. eapply Rle_trans; [apply (inverse_below high); lra | apply Rinv_le; lra]. Qed.

(** The other way: the room is turned round, and the range surely covered. *)
Theorem nearness_covers t : 0 < t <= bpow radix2 1024 ->
  / t <= nearness_low (- room4) t /\ nearness_high (- room4) t <= / t.
Proof.
  intros T. destruct (inverse_below t T) as [L H]. unfold nearness_low, nearness_high in *.
  replace (1 - - room4) with (1 + room4) by ring. replace (1 + - room4) with (1 - room4) by ring. now split.
Qed.

Lemma inverse_less x y : 0 < x -> 0 < y -> / x < / y -> y < x.
Proof. intros X Y H. apply Rnot_le_lt. intros C. generalize (Rinv_le x y X C). lra. Qed.

(** `ClipRange`, perspective, for a surface with 1 / t between least and most. *)
Section Clip.
Variables start end_ least most t : R.
Hypothesis ends : 0 < start <= bpow radix2 1024 /\ 0 < end_ <= bpow radix2 1024.
Hypothesis enclosed : 0 < t /\ least <= / t <= most.

Theorem surely_inside : least > nearness_low (- room4) end_ -> most < nearness_high (- room4) start ->
  start < t < end_.
Proof.
  intros L M. destruct ends as [S E], enclosed as [P N].
  destruct (nearness_covers end_ E) as [E1 _]. destruct (nearness_covers start S) as [_ S1].
  assert (A1 : / end_ < / t) by lra. assert (A2 : / t < / start) by lra.
  split; apply inverse_less; lra.
Qed.

Theorem surely_outside : most < nearness_low room4 end_ \/ least > nearness_high room4 start ->
  t < start \/ end_ < t.
Proof.
  destruct ends as [S E], enclosed as [P N]. intros [H|H].
  - right. destruct (inverse_below end_ E) as [I _]. apply inverse_less; lra.
  - left. destruct (inverse_below start S) as [_ I]. apply inverse_less; lra.
Qed.
End Clip.

(** Of parallel rays the nearness is -t: from -high to -low, and nothing is rounded. *)
Theorem parallel_encloses low high t : low <= t <= high -> - high <= - t <= - low.
Proof. lra. Qed.
Theorem parallel_inside start end_ least most t : least <= - t <= most ->
  least > - end_ -> most < - start -> start < t < end_.
Proof. lra. Qed.
Theorem parallel_outside start end_ least most t : least <= - t <= most ->
  most < - end_ \/ least > - start -> t < start \/ end_ < t.
Proof. lra. Qed.
