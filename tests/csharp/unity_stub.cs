// The part of Unity's interface that the script of docs/csharp.md uses, to compile it without Unity.
namespace UnityEngine {
    public struct Vector3 {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    }

    public struct Matrix4x4 {
        public float this[int row, int column] { get { return row == column ? 1 : 0; } }
    }

    public class Object { }

    public class Transform {
        public Matrix4x4 localToWorldMatrix { get { return new Matrix4x4(); } }
        public Vector3 position { get; set; }
    }

    public class Mesh : Object {
        public Vector3[] vertices { get { return new Vector3[0]; } }
        public int[] triangles { get { return new int[0]; } }
    }

    public class Component : Object {
        public Transform transform { get { return new Transform(); } }
        public T GetComponent<T>() where T : new() { return new T(); }
    }

    public class MeshFilter : Component {
        public Mesh sharedMesh { get { return new Mesh(); } }
    }

    public class MonoBehaviour : Component {
        public bool enabled;
    }

    public static class Debug {
        public static void Log(object message) { }
        public static void LogWarning(object message) { }
    }
}
