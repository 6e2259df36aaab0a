(** A scene of two triangles and one ray, computed by Coq from the recorded expressions, to the bit.

    `tests/proof/test_two_triangles.py` reads the numbers here, traces the scene, and holds owner and
    t to what is claimed. All lengths are sixteenths of a metre. *)
Require Import ZArith List Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Trees Pairs CodeAnswers CertifiedDepth.
From Reftrace Require Contest Integers Hits Ties Leaf.
Import ListNotations.
Open Scope Z_scope.

Definition at_ x y z := F3 (num x (-4)) (num y (-4)) (num z (-4)).
Definition far := StoredTriangle (at_ (-17) (-15) (-83)) (at_ 21 (-13) (-91)) (at_ 3 22 (-78)).
Definition near := StoredTriangle (at_ (-16) (-16) (-48)) (at_ 32 (-16) (-53)) (at_ 0 32 (-44)).
Definition from := at_ 0 0 0.
Definition along := at_ 2 (-2) (-16).
Definition reach := at_ 2 2 16. (* |d|, as there is no other ray *)

(** Their names are (0, 0) and (1, 0). *)
Definition surface_far := Contest.Surface (0, 0) (shape_stored far).
Definition surface_near := Contest.Surface (1, 0) (shape_stored near).
Definition scene : inputs :=
  Inputs from along (FromOnePoint reach) (num 1 (-4)) (num 100 0)
    (fun s => if fst (Contest.called s) =? 0 then far else near)
    (fun _ _ => Batch [] []) (fun _ _ => Batch [] []) (fun _ _ => None) (fun _ => None).

(** In binary64: both are surely met, and the near one's interval ends before the far one's begins. *)
Theorem both_are_sure : code_sure scene surface_far && code_sure scene surface_near = true.
Proof. vm_compute. reflexivity. Qed.
Theorem near_is_nearer :
  Bcompare (high_float scene surface_near) (low_float scene surface_far) = Some Datatypes.Lt.
Proof. vm_compute. reflexivity. Qed.

(** Its t is surely rounded correctly, and is this float. *)
Definition t_of_near := num 6916242284890405 (-51).
Theorem t_is_sure : recorded_sure scene (ForOneOrigin reach) surface_near = true.
Proof. vm_compute. reflexivity. Qed.
Theorem t_is : Bcompare (recorded_t scene (ForOneOrigin reach) surface_near) t_of_near = Some Datatypes.Eq.
Proof. vm_compute. reflexivity. Qed.

(** In integers, in sixteenths: both are met, at no edge, and the near one is nearer. *)
Definition hit_far := Integers.hit (Integers.I3 2 (-2) (-16)) Integers.ZERO
  (Integers.I3 (-17) (-15) (-83)) (Integers.I3 21 (-13) (-91)) (Integers.I3 3 22 (-78)).
Definition hit_near := Integers.hit (Integers.I3 2 (-2) (-16)) Integers.ZERO
  (Integers.I3 (-16) (-16) (-48)) (Integers.I3 32 (-16) (-53)) (Integers.I3 0 32 (-44)).
Theorem integers_agree :
  match hit_far, hit_near with
  | Some f, Some n =>
      negb (Hits.on_edge f) && negb (Hits.on_edge n) && (Integers.gap n f <? 0) &&
      (Hits.sign_of_difference Ties.PERTURBATION n f <? 0)
  | _, _ => false
  end = true.
Proof. vm_compute. reflexivity. Qed.

(** The checker of certificates sees the near one, without ties, and its t is that float. *)
Definition checked_far := Leaf.hit (1, 16) (100, 1) (0, 0) (Integers.I3 2 (-2) (-16))
  (Leaf.of_triangle Integers.ZERO
    (Integers.I3 (-17) (-15) (-83)) (Integers.I3 21 (-13) (-91)) (Integers.I3 3 22 (-78))).
Definition checked_near := Leaf.hit (1, 16) (100, 1) (1, 0) (Integers.I3 2 (-2) (-16))
  (Leaf.of_triangle Integers.ZERO
    (Integers.I3 (-16) (-16) (-48)) (Integers.I3 32 (-16) (-53)) (Integers.I3 0 32 (-44))).
Definition quotient n d : float :=
  Bdiv mode_NE (binary_normalize prec emax _ _ mode_NE n 0 false)
    (binary_normalize prec emax _ _ mode_NE d 0 false).
Theorem checker_agrees :
  match checked_far, checked_near with
  | Some f, Some n =>
      match Leaf.sees [f; n] with
      | (Some seen, ties) =>
          (fst (Leaf.named seen) =? 1) && negb ties &&
          match Bcompare (quotient (Leaf.top seen) (Leaf.bottom seen)) t_of_near with
          | Some Datatypes.Eq => true | _ => false end
      | _ => false
      end
  | _, _ => false
  end = true.
Proof. vm_compute. reflexivity. Qed.
